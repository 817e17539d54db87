/// \file
/// Faces that meet, removed, and the holes they leave.

#include <libmesh/repair/greedy_vertex_cover.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/repaired.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using test::two_balls;

using mode = tf::resolve_mode;

}  // namespace

TEST_CASE("repair: a spike through the other side is removed and its holes are closed") {
    tf::mesh mesh = test::ball(4, 1.0);
    mesh.points[4] = {0.03, 0.02, -1.5};  // the top pulled down through the bottom
    REQUIRE(!tf::self_intersections(mesh).pairs.empty());
    const auto result = tf::resolve_self_intersections(mesh, mode::remove);
    CHECK(result.certificate);
    CHECK(result.statistics.removed > 0);
    CHECK(result.statistics.filled > 0);
    CHECK(result.statistics.message() == "8 faces removed, 4 faces filled in");
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    const auto counts = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    CHECK(counts.closed_manifold);
    CHECK(counts.misoriented_edges == 0);
    CHECK(result.face_source.size() == result.mesh.faces.size());
    CHECK(result.certificate.max_displacement == 0.0);
}

TEST_CASE("repair: removing faces leaves a border where there was one") {
    test::random source(5);
    tf::mesh mesh = test::grid(20);
    mesh.points[220] = {5.5, 5.5, 0.0};  // folds over its neighbors
    const auto before = tf::count_topology(mesh.points.size(), mesh.faces);
    REQUIRE(!tf::self_intersections(mesh).pairs.empty());
    const auto result = tf::resolve_self_intersections(mesh, mode::remove);
    CHECK(result.certificate);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    const auto after = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    CHECK(after.boundary_edges == before.boundary_edges);
    CHECK(after.components_by_edge == 1);
}

TEST_CASE("repair: a notch in the border is filled up to where the border was") {
    tf::mesh mesh = test::grid(20);
    mesh.points[10] = {10.0, 3.5, 0.0};  // of the border, over three rows of faces
    const auto before = tf::count_topology(mesh.points.size(), mesh.faces);
    REQUIRE(!tf::self_intersections(mesh).pairs.empty());
    const auto result = tf::resolve_self_intersections(mesh, mode::remove);
    CHECK(result.certificate);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    const auto after = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    CHECK(after.components_by_edge == 1);
    CHECK(after.boundary_edges <= before.boundary_edges + result.statistics.left_open);
    CHECK(result.statistics.removed < 20);
}

TEST_CASE("repair: where what is deleted goes around a border, no face is left by itself there") {
    constexpr std::uint32_t around = 6, rings = 9;
    tf::mesh tube;
    for (std::uint32_t i = 0; i < around * rings; ++i) {
        const double angle = i * (2 * 3.14159265358979 / around);
        const double radius = i / around == 1 ? -0.9 - 0.01 * i : 1.0;  // the second one turned
        tube.points.push_back(
            {radius * std::cos(angle), radius * std::sin(angle), 0.5 * (i / around)});
    }
    for (std::uint32_t i = 0; i < around * (rings - 1); ++i) {
        const std::uint32_t next = i + 1 - ((i + 1) % around == 0 ? around : 0);
        tube.faces.push_back({i, next, next + around});
        tube.faces.push_back({i, next + around, i + around});
    }
    REQUIRE(!tf::self_intersections(tube).pairs.empty());
    const auto result = tf::resolve_self_intersections(tube, mode::remove, {.max_loss = 1.0});
    CHECK(result.certificate);
    CHECK(result.statistics.left_open > 0);
    CHECK(result.statistics.removed < 4 * around);  // less than all at the ring
    const auto component = tf::face_components(result.mesh.points.size(), result.mesh.faces);
    std::set<std::uint32_t> all(component.begin(), component.end()), with_given;
    for (std::size_t f = 0; f < component.size(); ++f)
        if (result.face_source[f] != tf::repair_result::none) with_given.insert(component[f]);
    CHECK(with_given == all);
}

TEST_CASE("repair: of two open sheets that pass through each other, one is cut open") {
    const tf::mesh sheet = test::grid(20);
    const tf::mesh other = test::moved(test::turned(sheet, {1, 0, 0}, 1.5), {0.3, 10.2, -9.7});
    const tf::mesh mesh = test::together(sheet, other);
    std::vector<char> meets(mesh.faces.size());
    for (const tf::face_pair& pair : tf::self_intersections(mesh).pairs)
        meets[pair.a] = meets[pair.b] = 1;
    REQUIRE(std::ranges::count(meets, 1) > 0);
    const auto result = tf::resolve_self_intersections(mesh, mode::remove);
    CHECK(result.certificate);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    CHECK(result.statistics.vanished_components == 0);
    CHECK(result.statistics.left_open > 0);
    for (std::uint32_t f = 0; f < meets.size(); ++f)  // nothing else is touched
        if (meets[f] == 0) CHECK(std::ranges::count(result.face_source, f) == 1);
    CHECK(result.statistics.removed < static_cast<std::uint64_t>(std::ranges::count(meets, 1)));
}

TEST_CASE("repair: a closed part that an open sheet passes through stays as it is") {
    const tf::mesh ball = test::ball(3, 6.0);
    const tf::mesh mesh = test::together(ball, test::moved(test::grid(20), {-10.1, -9.8, 0.3}));
    const auto result = tf::resolve_self_intersections(mesh, mode::remove);
    CHECK(result.certificate);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    CHECK(result.statistics.vanished_components == 0);
    for (std::uint32_t f = 0; f < ball.faces.size(); ++f)
        CHECK(std::ranges::count(result.face_source, f) == 1);
}

TEST_CASE("repair: removing leaves no edge of a closed part open") {
    const tf::mesh mesh = test::together(two_balls(), test::moved(test::grid(3), {5, 5, 5}));
    const auto result = tf::resolve_self_intersections(mesh, mode::remove, {.max_loss = 1.0});
    CHECK(result.certificate);
    CHECK(result.statistics.left_open == 0);
    const auto counts = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    CHECK(counts.boundary_edges == 12);  // of the sheet far away
}

TEST_CASE("repair: of faces on each other one is left, and of a face and its back none") {
    tf::mesh twice = test::grid(4);
    twice.faces.push_back(twice.faces[12]);
    const auto result = tf::resolve_self_intersections(twice, mode::remove);
    CHECK(result.certificate);
    CHECK(result.mesh.faces.size() == test::grid(4).faces.size());
    CHECK(result.statistics.left_open == 0);
    tf::mesh flap = test::ball(1, 1.0);
    flap.points.push_back({3, 3, 3});
    flap.faces.push_back({0, 6, 18});
    flap.faces.push_back({0, 18, 6});
    const auto without = tf::resolve_self_intersections(flap, mode::remove);
    CHECK(without.certificate);
    CHECK(without.mesh == test::ball(1, 1.0));
}

TEST_CASE("repair: of a sheet with a back, or a solid twice, one copy is left") {
    const tf::mesh sheet = test::grid(4), ball = test::ball(2, 1.0);
    for (const bool closed : {false, true}) {
        const tf::mesh one = closed ? ball : sheet;
        for (const tf::mesh& other : {one, test::inside_out(one)}) {
            tf::mesh both = one;
            both.faces.insert(both.faces.end(), other.faces.begin(), other.faces.end());
            const auto result = tf::resolve_self_intersections(both, mode::remove);
            CHECK(result.certificate);
            CHECK(result.mesh == one);
            CHECK(result.statistics.removed == one.faces.size());
            CHECK(result.statistics.left_open == (closed || other == one ? 0 : 16));
        }
    }
}

TEST_CASE("repair: the copy that is left runs the same way round everywhere, in whatever order") {
    test::random source(8);
    for (const bool closed : {false, true})
        for (int i = 0; i < 10; ++i) {
            const tf::mesh one = closed ? test::ball(2, 1.0) : test::grid(4);
            tf::mesh both{one.points, {}};
            for (const tf::mesh& copies : {one, test::inside_out(one)})
                for (const tf::face& f : copies.faces)
                    for (std::size_t k = 0; k <= source.below(2); ++k) both.faces.push_back(f);
            const tf::mesh mesh = test::shuffled(source, both).mesh;
            const auto result = tf::resolve_self_intersections(mesh, mode::remove);
            CHECK(result.certificate);
            CHECK(result.mesh.faces.size() == one.faces.size());
            CHECK(result.face_source.front() == 0);  // whose way it is
            CHECK(result.statistics.left_open == (closed ? 0 : 16));
            const auto counts = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
            CHECK(counts.misoriented_edges == 0);
            CHECK(counts.boundary_edges == (closed ? 0 : 16));
        }
}

TEST_CASE("repair: a sheet whose back ends before it does not vanish") {
    tf::mesh both = test::grid(4);
    const auto count = both.faces.size();
    for (const tf::face& f : test::inside_out(test::grid(4)).faces) both.faces.push_back(f);
    both.faces.pop_back();
    const auto result = tf::resolve_self_intersections(both, mode::remove);
    CHECK(result.certificate);
    CHECK(result.mesh.faces.size() == count);
    CHECK(result.statistics.vanished_components == 0);
}

TEST_CASE("repair: of random sheets, what is removed never leaves faces that meet") {
    test::random source(6);
    int certified = 0;
    for (int i = 0; i < 30; ++i) {
        CAPTURE(i);
        const tf::mesh mesh = i % 3 == 0 ? test::random_soup(source, 40, 0.4)
                              : i % 3 == 1
                                  ? tf::join_equal_points(test::lattice_soup(source, 30, 20, 3))
                                  : test::fan(source, 30);
        for (const bool touching : {false, true}) {
            const auto result = tf::resolve_self_intersections(
                mesh, mode::remove, {.touching = touching, .max_loss = 1.0});
            if (!result.certificate) continue;
            ++certified;
            for (const tf::face_pair& pair : tf::self_intersections(result.mesh).pairs) {
                CHECK(!touching);
                CHECK(pair.kind == tf::pair_kind::touching);
                CHECK(result.face_source[pair.a] != tf::repair_result::none);
                CHECK(result.face_source[pair.b] != tf::repair_result::none);
            }
        }
    }
    CHECK(certified > 50);  // of 60
}

TEST_CASE("repair: faces that only touch are deleted on request") {
    const tf::mesh wall = test::moved(test::turned(test::grid(4), {1, 0, 0}, 1.5), {0.5, 2.0, 0.0});
    tf::mesh mesh = test::together(test::grid(5), wall);
    for (tf::point3& p : mesh.points) p.z = std::max(p.z, 0.0);
    const auto found = tf::self_intersections(mesh);
    REQUIRE(!found.pairs.empty());
    for (const tf::face_pair& pair : found.pairs) REQUIRE(pair.kind == tf::pair_kind::touching);
    CHECK(tf::resolve_self_intersections(mesh, mode::remove).mesh == mesh);
    const auto result =
        tf::resolve_self_intersections(mesh, mode::remove, {.touching = true, .max_loss = 1.0});
    CHECK(result.certificate);
    CHECK(result.statistics.removed > 0);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
}

TEST_CASE("repair: of each pair one face is chosen, that in the most pairs first") {
    using pairs = std::vector<std::array<std::uint32_t, 2>>;
    const auto few = [](const pairs& p, std::vector<std::uint8_t> spared) {
        return tf::detail::repair::greedy_vertex_cover(p, spared);
    };
    using chosen = std::vector<std::uint8_t>;
    CHECK(few({{0, 3}, {1, 3}, {2, 3}}, chosen(5, 0)) == chosen{0, 0, 0, 1, 0});
    CHECK(few({{0, 1}}, chosen(2, 0)) == chosen{1, 0});
    CHECK(few({{0, 3}, {1, 3}, {2, 3}}, {0, 0, 0, 1}) == chosen{1, 1, 1, 0});
    CHECK(few({{0, 1}}, {1, 1}) == chosen{1, 1});
    CHECK(few({{1, 1}, {1, 2}}, {0, 0, 0}) == chosen{0, 1, 0});
    CHECK(few({}, {}).empty());
    test::random source(7);
    for (int i = 0; i < 200; ++i) {
        pairs p;
        std::vector<std::uint8_t> spared(12);
        for (auto& s : spared) s = source.below(4) == 0 ? 1 : 0;
        for (std::size_t k = source.below(30); k > 0; --k)
            p.push_back({static_cast<std::uint32_t>(source.below(12)),
                         static_cast<std::uint32_t>(source.below(12))});
        const auto taken = few(p, spared);
        for (const auto& [a, b] : p) {
            CHECK(taken[a] + taken[b] > 0);
            if (spared[a] != 0 && spared[b] != 0) CHECK(taken[a] + taken[b] == 2);
        }
    }
}

TEST_CASE("repair: a component that is nothing but faces that meet is counted as lost") {
    const tf::mesh mesh = test::together(
        test::ball(2, 1.0), {{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    const auto result = tf::resolve_self_intersections(mesh, mode::outer);
    CHECK(result.certificate);
    CHECK(result.statistics.vanished_components == 1);
    CHECK(result.statistics.removed == 2);
}
