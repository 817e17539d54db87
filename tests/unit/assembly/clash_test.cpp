#include <libmesh/assembly/part_names.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/assemblies.hpp>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;
using test::prepared;
using tf::mesh_relation;

tf::clash_result clash_of(const std::vector<tf::mesh>& parts,
                          const tf::clash_options& options = {}) {
    return tf::clash(prepared(parts), options);
}

tf::clash_options with_clearance(double clearance) {
    tf::clash_options options;
    options.clearance = clearance;
    return options;
}

}  // namespace

TEST_CASE("clash: nothing, one part, and parts without faces are clear") {
    CHECK(clash_of({}).pairs.empty());
    CHECK(clash_of({box(1, 1, 1)}).pairs.empty());
    const auto found = clash_of({box(1, 1, 1), {}, {}});
    CHECK(found.pairs.empty());
    CHECK(found.boxes_apart == 3);
    CHECK(found.parts_indexed == 0);
}

TEST_CASE("clash: boxes apart, touching and penetrating, with volume, depth and region") {
    const auto found = clash_of({box(2, 2, 2), moved(box(2, 2, 2), {1.5, 0.5, 0.5}),
                                 moved(box(1, 1, 1), {-1, 0, 0}), moved(box(1, 1, 1), {50, 0, 0})});
    REQUIRE(found.pairs.size() == 2);
    const tf::part_clash& deep = found.pairs[0];
    CHECK(deep.a == 0);
    CHECK(deep.b == 1);
    CHECK(deep.relation == mesh_relation::penetrating);
    CHECK(deep.volume.value() == doctest::Approx(0.5 * 1.5 * 1.5).epsilon(1e-15));
    CHECK(deep.depth.value() == 0.5);
    CHECK(deep.move == tf::point3{-0.5, 0, 0});
    REQUIRE(deep.regions.size() == 1);
    CHECK(deep.regions[0].box.min == tf::point3{1.5, 0.5, 0.5});
    CHECK(deep.regions[0].box.max == tf::point3{2, 2, 2});
    CHECK(deep.regions[0].face_pairs == deep.face_pairs);
    CHECK(found.pairs[1].relation == mesh_relation::touching);
    CHECK(found.pairs[1].b == 2);
    CHECK_FALSE(found.pairs[1].volume.has_value());
    CHECK_FALSE(found.pairs[1].depth.has_value());
    CHECK(found.clashes == 1);
    CHECK(found.boxes_apart == 4);
    CHECK(found.parts_indexed == 3);
}

TEST_CASE("clash: a part that is inside out penetrates with the same volume and depth") {
    const tf::mesh a = box(1, 1, 1), b = moved(box(1, 1, 1), {0.5, 0, 0});
    const auto expected = clash_of({a, b});
    REQUIRE(expected.pairs.size() == 1);
    REQUIRE(expected.pairs[0].relation == mesh_relation::penetrating);
    for (const auto& parts :
         {std::vector{test::inside_out(a), b}, std::vector{a, test::inside_out(b)},
          std::vector{test::inside_out(a), test::inside_out(b)}}) {
        const auto found = clash_of(parts);
        REQUIRE(found.pairs.size() == 1);
        CHECK(found.pairs[0].relation == mesh_relation::penetrating);
        CHECK(found.pairs[0].volume == doctest::Approx(0.5));
        CHECK(found.pairs[0].depth == expected.pairs[0].depth);
        CHECK(found.clashes == 1);
    }
}

TEST_CASE("clash: a part inside another one has no region, but a depth, a volume and a distance") {
    const auto found = clash_of({box(4, 4, 4), moved(box(1, 1, 1), {1, 1.25, 1.5})});
    REQUIRE(found.pairs.size() == 1);
    CHECK(found.pairs[0].relation == mesh_relation::penetrating);
    CHECK(found.pairs[0].b_inside_a);
    CHECK(found.pairs[0].regions.empty());
    CHECK(found.pairs[0].distance == 1.0);
    CHECK(found.pairs[0].volume.value() == 1.0);
    CHECK(found.pairs[0].depth.value() == 2.0);
}

TEST_CASE("clash: a clearance is kept by what is exactly as far") {
    const std::vector<tf::mesh> parts{box(1, 1, 1), moved(box(1, 1, 1), {1.25, 0, 0})};
    CHECK(clash_of(parts, with_clearance(0.25)).pairs.empty());
    const auto near = clash_of(parts, with_clearance(std::nextafter(0.25, 1.0)));
    REQUIRE(near.pairs.size() == 1);
    CHECK(near.pairs[0].relation == mesh_relation::closer_than_clearance);
    CHECK(near.pairs[0].distance == 0.25);
    CHECK((*near.pairs[0].nearest)[0].x == 1.0);
    CHECK(near.clashes == 1);
    const std::vector<tf::mesh> touching{box(1, 1, 1), moved(box(1, 1, 1), {1, 0, 0})};
    CHECK(clash_of(touching).clashes == 0);
    CHECK(clash_of(touching, with_clearance(0.1)).clashes == 1);
    CHECK_THROWS_AS(clash_of(touching, with_clearance(-1)), std::invalid_argument);
    CHECK_THROWS_AS(clash_of(touching, with_clearance(std::nan(""))), std::invalid_argument);
}

TEST_CASE("clash: rings, L shapes and chains whose boxes overlap are clear when they do not meet") {
    const auto chain = clash_of(test::chain(30));
    CHECK(chain.pairs.empty());
    CHECK(chain.counts[tf::mesh_relation::disjoint] == 29);  // neighbors, by their boxes
    const tf::mesh hook = moved(test::turned(test::l_bracket(3, 3), {0, 0, 1}, 3.1), {5, 4.9, 0});
    CHECK(clash_of({test::l_bracket(4, 4), hook}).pairs.empty());
    CHECK(clash_of({test::ring(3, 0.5, 32, 8), test::ring(1.5, 0.5, 32, 8)}).pairs.empty());
}

TEST_CASE(
    "clash: a rod through a plate meets it in two regions, two rods through one face in four") {
    const auto plate = box(10, 10, 1);
    const auto rod = moved(box(1, 1, 5), {2, 2, -2}), other = moved(box(1, 1, 5), {3.5, 2, -2});
    CHECK(clash_of({plate, rod}).pairs[0].regions.size() == 2);
    const auto both = clash_of({plate, test::together(rod, other)});
    REQUIRE(both.pairs.size() == 1);
    CHECK(both.pairs[0].regions.size() == 4);
    CHECK(both.pairs[0].volume.value() == doctest::Approx(2.0));
}

TEST_CASE("clash: what it says of random parts is what relation and distance say, two by two") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        std::vector<tf::mesh> parts;
        for (int i = 0; i < 24; ++i) {
            const tf::mesh one = i % 3 == 0   ? test::lattice_box(source)
                                 : i % 3 == 1 ? test::random_tetrahedron(source, 2.0)
                                              : ball(1, 0.8);
            parts.push_back(moved(one, {source.in(0, 5), std::floor(source.in(0, 5)), 0}));
        }
        tf::clash_options options = with_clearance(0.3);
        options.depths = options.volumes = false;
        const auto found = clash_of(parts, options);
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < parts.size(); ++i)
            for (std::uint32_t j = i + 1; j < parts.size(); ++j) {
                const auto how = tf::relation(parts[i], parts[j]).relation;
                const double apart = tf::distance(parts[i], parts[j]);
                if (how == tf::mesh_relation::disjoint && apart >= 0.3) continue;
                REQUIRE(next < found.pairs.size());
                const tf::part_clash& one = found.pairs[next++];
                REQUIRE(one.a == i);
                REQUIRE(one.b == j);
                CHECK(one.relation ==
                      (how == tf::mesh_relation::disjoint   ? mesh_relation::closer_than_clearance
                       : how == tf::mesh_relation::touching ? mesh_relation::touching
                                                            : mesh_relation::penetrating));
                CHECK(one.distance == apart);
            }
        CHECK(next == found.pairs.size());
    }
}

TEST_CASE("clash: ignored pairs are left out, whichever way round, and have to exist") {
    const std::vector<tf::mesh> parts{box(2, 2, 2), moved(box(2, 2, 2), {1, 1, 1}),
                                      moved(box(2, 2, 2), {1.5, 0, 0})};
    const std::vector<tf::part_pair> ignored{{1, 0}, {0, 1}, {2, 1}};
    tf::clash_options options;
    options.ignored = ignored;
    const auto found = clash_of(parts, options);
    REQUIRE(found.pairs.size() == 1);
    CHECK(found.pairs[0].b == 2);
    CHECK(found.ignored == 2);
    const std::vector<tf::part_pair> none{{0, 3}};
    options.ignored = none;
    CHECK_THROWS_WITH_AS(clash_of(parts, options),
                         "treeform::clash: an ignored pair has part 3, but there are 3 parts",
                         std::invalid_argument);
}

TEST_CASE("clash: an open part has no volume in common, a cloud penetrates with its points") {
    tf::mesh open = box(2, 2, 2);
    open.faces.pop_back();
    const auto found = clash_of({open, moved(box(2, 2, 2), {1, 1, 1})});
    REQUIRE(found.pairs.size() == 1);
    CHECK(found.pairs[0].relation == mesh_relation::penetrating);
    CHECK_FALSE(found.pairs[0].volume.has_value());
    CHECK(found.pairs[0].depth.has_value());
    std::vector<tf::prepared_mesh> parts;
    parts.emplace_back(box(2, 2, 2));
    parts.push_back(tf::prepared_mesh(tf::mesh{{{1, 1, 1}, {9, 9, 9}}}));
    const auto cloud = tf::clash(parts);
    REQUIRE(cloud.pairs.size() == 1);
    CHECK(cloud.pairs[0].relation == mesh_relation::penetrating);
    CHECK_FALSE(cloud.pairs[0].depth.has_value());
}

TEST_CASE("clash: of ten thousand parts only those that are near another are indexed") {
    std::vector<tf::mesh> parts;
    for (int i = 0; i < 10000; ++i)
        parts.push_back(moved(box(1, 1, 1), {2.0 * (i % 100), 2.0 * (i / 100), 0}));
    parts[77] = moved(parts[77], {1.5, 0, 0});
    const auto found = clash_of(parts);
    REQUIRE(found.pairs.size() == 1);
    CHECK(found.pairs[0].a == 77);
    CHECK(found.pairs[0].b == 78);
    CHECK(found.pairs[0].depth.value() == 0.5);
    CHECK(found.parts_indexed == 2);
    CHECK(found.boxes_apart == 10000ULL * 9999 / 2 - 1);
}

TEST_CASE("clash: the same on one thread, of views, and none when told to stop") {
    test::random source(9);
    std::vector<tf::mesh> parts;
    for (int i = 0; i < 12; ++i)
        parts.push_back(moved(ball(2, 1.0), {source.in(0, 4), source.in(0, 4), 0}));
    const auto all = clash_of(parts);
    std::vector<tf::mesh_view> views(parts.begin(), parts.end());
    const tf::thread_scope one(1);
    const auto single = tf::clash(views);
    REQUIRE(all.pairs.size() == single.pairs.size());
    CHECK(all.pairs.size() > 5);
    for (std::size_t i = 0; i < all.pairs.size(); ++i) {
        CHECK(all.pairs[i].volume == single.pairs[i].volume);
        CHECK(all.pairs[i].move == single.pairs[i].move);
        CHECK(all.pairs[i].face_pairs == single.pairs[i].face_pairs);
    }
    tf::clash_options options;
    options.progress = [](double) { return false; };
    CHECK(clash_of(parts, options).status == tf::status::cancelled);
    parts[3].points[0].y = std::nan("");
    CHECK_THROWS_AS(clash_of(parts), std::invalid_argument);
}

TEST_CASE("names: globs match what they say, and pairs of names are found once") {
    CHECK(tf::detail::assembly::matches("bolt*", "bolt"));
    CHECK(tf::detail::assembly::matches("*", ""));
    CHECK(tf::detail::assembly::matches("b?lt_*_a", "bolt_12_b_a"));
    CHECK(tf::detail::assembly::matches("*a*b*c", "xxaxxbxxbc"));
    CHECK_FALSE(tf::detail::assembly::matches("b?lt", "blt"));
    CHECK_FALSE(tf::detail::assembly::matches("", "a"));
    CHECK_FALSE(tf::detail::assembly::matches("a*b", "a*bc"));
    const std::vector<std::string> names{"nut", "bolt 1", "bolt 2", "plate"};
    using pairs = std::vector<tf::part_pair>;
    CHECK(tf::pairs_named(names, "bolt*", "nut") == pairs{{0, 1}, {0, 2}});
    CHECK(tf::pairs_named(names, "bolt*", "bolt*") == pairs{{1, 2}});
    CHECK(tf::pairs_named(names, "*", "plate") == pairs{{0, 3}, {1, 3}, {2, 3}});
    CHECK(tf::pairs_named(names, "nut", "screw").empty());
}
