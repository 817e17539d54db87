#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/assemblies.hpp>
#include <support/random.hpp>
#include <support/scans.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::prepared;
using tf::mesh_relation;
using motion = tf::transform<3>;

motion random_motion(test::random& source, double reach) {
    const tf::point3 by{source.in(-reach, reach), source.in(-reach, reach),
                        source.in(-reach, reach)};
    return test::turn_about(test::direction(source), source.in(0, 3), {0, 0, 0}, by);
}

tf::mesh placed(tf::mesh mesh, const motion& by) {
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

/// What `clash` says of the parts where they are moved to.
void check_by_moving(const std::vector<tf::mesh>& parts, const std::vector<motion>& poses,
                     double clearance) {
    tf::clash_options options;
    options.clearance = clearance;
    const auto found = tf::check_poses(prepared(parts), poses, options);
    REQUIRE(found.poses.size() == poses.size() / parts.size());
    for (std::size_t p = 0; p < found.poses.size(); ++p) {
        CAPTURE(p);
        std::vector<tf::mesh> there;
        for (std::size_t i = 0; i < parts.size(); ++i)
            there.push_back(placed(parts[i], poses[p * parts.size() + i]));
        tf::clash_options plain;
        plain.clearance = clearance;
        plain.volumes = plain.depths = false;
        const auto each = tf::clash(prepared(there), plain);
        REQUIRE(found.poses[p].size() == each.pairs.size());
        for (std::size_t i = 0; i < each.pairs.size(); ++i) {
            CHECK(found.poses[p][i].a == each.pairs[i].a);
            CHECK(found.poses[p][i].b == each.pairs[i].b);
            CHECK(found.poses[p][i].relation == each.pairs[i].relation);
            if (each.pairs[i].relation == mesh_relation::closer_than_clearance)
                CHECK(found.poses[p][i].distance == doctest::Approx(each.pairs[i].distance));
        }
    }
}

}  // namespace

TEST_CASE("poses: batches say what single questions say, in their order") {
    test::random source(1);
    const tf::prepared_mesh a(ball(2, 1.0)), b(test::ring(1.5, 0.3, 20, 8));
    std::vector<tf::mesh_pair_options> positions;
    for (int i = 0; i < 300; ++i)
        positions.push_back(
            {.transform_a = random_motion(source, 1.5), .transform_b = random_motion(source, 1.5)});
    const auto meet = tf::intersects(a, b, positions);
    const auto apart = tf::distance(a, b, positions);
    auto within = positions;
    for (tf::mesh_pair_options& one : within) one.radius = 0.5;
    const auto near = tf::distance(a, b, within);
    std::size_t meeting = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        REQUIRE(meet[i] == tf::intersects(a, b, positions[i]));
        REQUIRE(apart[i] ==
                tf::distance(a, b, {positions[i].transform_a, positions[i].transform_b}));
        REQUIRE((apart[i] == 0.0) == meet[i]);
        REQUIRE(near[i] == (apart[i] <= 0.5 ? apart[i] : std::numeric_limits<double>::infinity()));
        meeting += meet[i] ? 1 : 0;
    }
    CHECK(meeting > 50);
    CHECK(meeting < 250);
    CHECK(tf::intersects(a.indexed_view(), b.indexed_view(), positions) == meet);
    CHECK(tf::distance(a.indexed_view(), b.indexed_view(), positions) == apart);
    CHECK(tf::intersects(a, b, std::span<const tf::mesh_pair_options>()).empty());
}

TEST_CASE("poses: parts in many poses lie to each other as `clash` says of the moved ones") {
    test::random source(2);
    const std::vector<tf::mesh> parts{ball(1, 0.4), test::ring(1.0, 0.25, 12, 6), box(1, 2, 0.5),
                                      test::l_bracket(2, 3)};
    std::vector<motion> poses;
    for (int i = 0; i < 200 * 4; ++i) poses.push_back(random_motion(source, 2.0));
    check_by_moving(parts, poses, 0.0);
    check_by_moving(parts, poses, 0.2);
}

TEST_CASE("poses: a part inside another, in one of several components, and in a hollow") {
    const tf::mesh shell =
        test::together(box(4, 4, 4), test::inside_out(test::moved(box(2, 2, 2), {1, 1, 1})));
    const tf::mesh two =
        test::together(test::moved(box(0.5, 0.5, 0.5), {20, 20, 20}), box(0.5, 0.5, 0.5));
    std::vector<motion> poses;
    test::random source(3);
    for (int i = 0; i < 60; ++i) {
        poses.push_back(random_motion(source, 0.1));
        poses.push_back(tf::transform<3>::translation(
            tf::point3{source.in(0, 4), source.in(0, 4), source.in(0, 4)}));
    }
    check_by_moving({shell, two}, poses, 0.0);
}

TEST_CASE("poses: boxes on a lattice touch, overlap and lie on each other, exactly as moved") {
    test::random source(4);
    const std::vector<tf::mesh> parts{box(1, 1, 1), box(2, 1, 1), box(1, 1, 3)};
    std::vector<motion> poses;
    const auto whole = [&] { return static_cast<double>(source.below(4)); };
    for (int i = 0; i < 150 * 3; ++i)
        poses.push_back(tf::transform<3>::translation(tf::point3{whole(), whole(), whole()}));
    check_by_moving(parts, poses, 0.0);
    check_by_moving(parts, poses, 0.5);
    // Not a motion: squeezed, mirrored, flat.
    for (motion& m : poses) m.rows[source.below(3)][source.below(3)] = source.in(-2, 2);
    check_by_moving(parts, poses, 0.0);
}

TEST_CASE("poses: a pose that mirrors a part makes no other solid of it") {
    motion mirror;
    mirror.rows[0] = {-1.0, 0.0, 0.0, 1.0};
    const std::vector<tf::mesh> parts{
        test::together(box(1, 1, 1), test::moved(box(1, 1, 1), {3, 0, 0})), box(1, 1, 1)};
    const std::vector<motion> poses{
        mirror, tf::transform<3>::translation(tf::point3{0.5, 0, 0}),
        mirror, tf::transform<3>::translation(tf::point3{1, 0, 0}),
        mirror, tf::transform<3>::translation(tf::point3{-2.5, 0, 0}),
        {},     tf::transform<3>::translation(tf::point3{0.5, 0, 0}).after(mirror)};
    const auto found = tf::check_poses(test::prepared(parts), poses);
    REQUIRE(found.poses.size() == 4);
    const std::array expected{mesh_relation::penetrating, mesh_relation::touching,
                              mesh_relation::penetrating, mesh_relation::penetrating};
    for (std::size_t p = 0; p < 4; ++p) {
        REQUIRE(found.poses[p].size() == 1);
        CHECK(found.poses[p][0].relation == expected[p]);
    }
}

TEST_CASE("poses: ignored pairs, the first clash only, and counts") {
    const std::vector<tf::mesh> parts{box(1, 1, 1), box(1, 1, 1), box(1, 1, 1)};
    const motion none, aside = tf::transform<3>::translation(tf::point3{1, 0, 0}),
                       far = tf::transform<3>::translation(tf::point3{9, 0, 0});
    const std::vector<motion> poses{none, none, none, none, aside, far, none, far, aside};
    const auto all = tf::check_poses(prepared(parts), poses);
    CHECK(all.poses[0].size() == 3);
    REQUIRE(all.poses[1].size() == 1);
    CHECK(all.poses[1][0] == tf::pose_clash{0, 1, mesh_relation::touching, 0.0});
    CHECK(all.clashing == 1);
    CHECK(all.in_collision == std::vector<std::uint8_t>{1, 0, 0});
    tf::clash_options near;
    near.clearance = 0.5;  // then touching counts
    CHECK(tf::check_poses(prepared(parts), poses, near).in_collision ==
          std::vector<std::uint8_t>{1, 1, 1});
    CHECK(all.boxes_apart == 4);
    tf::clash_options options;
    options.first_only = true;
    const std::vector<tf::part_pair> ignored{{1, 0}};
    options.ignored = ignored;
    const auto some = tf::check_poses(prepared(parts), poses, options);
    REQUIRE(some.poses[0].size() == 1);
    CHECK(some.poses[0][0] == tf::pose_clash{0, 2, mesh_relation::penetrating, 0.0});
    CHECK(some.poses[1].empty());
    CHECK(some.poses[2].empty());  // they only touch
}

TEST_CASE("poses: what makes no sense is refused, and it stops when told to") {
    const auto parts = prepared({box(1, 1, 1), box(1, 1, 1)});
    std::vector<motion> poses(3);
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::check_poses(parts, poses)),
                         "treeform::check_poses: 3 transforms are not a multiple of 2 parts",
                         std::invalid_argument);
    poses.resize(4);
    poses[3].rows[0][0] = std::nan("");
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::check_poses(parts, poses)),
                         "treeform::check_poses: pose 1: the transform of part 1 is not finite",
                         std::invalid_argument);
    poses[3] = {};
    tf::clash_options options;
    options.progress = [](double) { return false; };
    CHECK(tf::check_poses(parts, poses, options).status == tf::status::cancelled);
    CHECK(tf::check_poses({}, {}).poses.empty());
}

TEST_CASE("poses: no index is built for a pose, and one thread says the same") {
    test::random source(5);
    const auto parts = prepared({ball(3, 0.5), test::ring(1.0, 0.3, 20, 8)});
    std::vector<motion> poses;
    for (int i = 0; i < 400; ++i) poses.push_back(random_motion(source, 1.0));
    const auto all = tf::check_poses(parts, poses);
    const auto built = parts[0].indexes_built() + parts[1].indexes_built();
    const tf::thread_scope one(1);
    CHECK(tf::check_poses(parts, poses).poses == all.poses);
    CHECK(parts[0].indexes_built() + parts[1].indexes_built() == built);
}
