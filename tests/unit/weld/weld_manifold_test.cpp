#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using ids = std::vector<std::uint32_t>;

tf::weld_result weld(const tf::mesh& mesh, double tolerance = 0.0, bool chain = false) {
    return tf::weld(mesh, {}, {.tolerance = tolerance, .chain = chain, .keep_manifold = true});
}

tf::topology_counts counts(const tf::mesh& mesh) {
    return tf::count_topology(mesh.points.size(), mesh.faces);
}

/// Each face with corners of its own.
tf::mesh soup_of(const tf::mesh& mesh) {
    tf::mesh soup;
    for (const tf::face& f : mesh.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : f) soup.points.push_back(mesh.points[corner]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

/// For each edge of more than two faces after merging: was it one edge before?
void check_edges(const tf::mesh& mesh, const ids& name) {
    using edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<edge, std::set<edge>> given;
    std::map<edge, int> uses;
    for (const tf::face& f : mesh.faces) {
        if (std::set(f.begin(), f.end()).size() < 3) continue;
        if (std::set{name[f[0]], name[f[1]], name[f[2]]}.size() < 3) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const edge old = std::minmax(f[k], f[(k + 1) % 3]);
            const edge now = std::minmax(name[old.first], name[old.second]);
            given[now].insert(old);
            ++uses[now];
        }
    }
    for (const auto& [now, old] : given)
        if (uses[now] > 2) CHECK(old.size() == 1);
}

void check_harmless(const tf::mesh& mesh, double tolerance, bool chain = false) {
    const tf::topology_counts before = counts(mesh);
    const tf::point_groups groups =
        tf::group_points(mesh.points, {.tolerance = tolerance, .chain = chain});
    for (const int rounds : {0, 1, 2, 32}) {
        CAPTURE(rounds);
        const auto split = tf::detail::weld::split_to_manifold(mesh, groups, rounds);
        const ids& part = split.groups.group_of_point;
        check_edges(mesh, part);
        // Each within one of the groups, numbered by first points.
        std::uint32_t next = 0;
        std::vector<std::set<std::uint32_t>> parts_of(groups.first_of_group.size());
        for (std::uint32_t v = 0; v < part.size(); ++v) {
            if (part[v] == next) CHECK(split.groups.first_of_group[next++] == v);
            const std::uint32_t first = split.groups.first_of_group[part[v]];
            CHECK(groups.group_of_point[first] == groups.group_of_point[v]);
            parts_of[groups.group_of_point[v]].insert(part[v]);
        }
        CHECK(next == split.groups.first_of_group.size());
        const auto several = [](const auto& parts) { return parts.size() > 1; };
        CHECK(split.split_up ==
              static_cast<std::uint64_t>(std::count_if(parts_of.begin(), parts_of.end(), several)));
    }
    const tf::weld_result welded = weld(mesh, tolerance, chain);
    CHECK(welded.statistics.nonmanifold_after <= welded.statistics.nonmanifold_before);
    CHECK(counts(welded.mesh).nonmanifold_points <= before.nonmanifold_points);
}

}  // namespace

TEST_CASE("keep_manifold: two cubes that share an edge come apart as two closed cubes") {
    const tf::mesh cube = tf::weld(tf::read(test::data_folder() / "cube.stl").mesh, {}, {}).mesh;
    const auto [low, high] = std::minmax_element(
        cube.points.begin(), cube.points.end(),
        [](const tf::point3& a, const tf::point3& b) { return a.x + a.y < b.x + b.y; });
    const tf::mesh cubes =
        soup_of(test::together(cube, test::moved(cube, {high->x - low->x, high->y - low->y, 0})));
    CHECK(tf::weld(cubes, {}, {}).statistics.nonmanifold_after == 1);
    const auto welded = weld(cubes);
    CHECK(welded.statistics.kept_apart == 2);
    CHECK(welded.mesh.points.size() == 16);
    const auto c = counts(welded.mesh);
    CHECK(c.closed_manifold);
    CHECK(c.components_by_point == 2);
    CHECK(welded.statistics.max_displacement == 0.0);
}

TEST_CASE("keep_manifold: surfaces cut to pieces close as without it") {
    for (const char* name : {"sphere.ply", "cube.stl", "two_spheres.stl", "nested_cubes.obj"}) {
        CAPTURE(name);
        const tf::mesh whole = tf::weld(tf::read(test::data_folder() / name).mesh, {}, {}).mesh;
        test::random source(1);
        const auto welded = weld(test::shuffled(source, soup_of(whole)).mesh);
        CHECK(welded.statistics.kept_apart == 0);
        CHECK(welded.mesh.points.size() == whole.points.size());
        CHECK(counts(welded.mesh).closed_manifold);
    }
    // One cut only: half of the faces take a copy of each point.
    tf::mesh sphere = tf::weld(tf::read(test::data_folder() / "sphere.ply").mesh, {}, {}).mesh;
    const auto count = static_cast<std::uint32_t>(sphere.points.size());
    const std::vector<tf::point3> points = sphere.points;
    sphere.points.insert(sphere.points.end(), points.begin(), points.end());
    for (std::size_t i = 0; i < sphere.faces.size() / 2; ++i)
        for (std::uint32_t& corner : sphere.faces[i]) corner += count;
    const auto welded = weld(sphere);
    CHECK(welded.statistics.kept_apart == 0);
    CHECK(welded.mesh.points.size() == count);
    CHECK(counts(welded.mesh).closed_manifold);
}

TEST_CASE("keep_manifold: solids that meet in a corner stay apart, and so do coinciding ones") {
    const tf::mesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    tf::mesh other = test::scaled(corner, -1.0);
    for (tf::face& f : other.faces) std::swap(f[0], f[1]);
    const tf::mesh both = test::together(corner, other);
    CHECK(counts(tf::weld(both, {}, {}).mesh).nonmanifold_points == 1);
    const auto welded = weld(both);
    CHECK(welded.mesh.points.size() == 8);
    CHECK(welded.statistics.kept_apart == 1);
    CHECK(weld(soup_of(both)).mesh.points.size() == 8);

    const tf::mesh twice = test::together(corner, corner);
    CHECK(weld(twice).mesh.points.size() == 8);
    CHECK(weld(twice).statistics.kept_apart == 4);
}

TEST_CASE("keep_manifold: an inner edge between two borders does not shrink, the others do") {
    // A strip of three squares; its cross edges are short.
    tf::mesh strip;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const double x = i;
        strip.points.push_back({x, 0, 0});
        strip.points.push_back({x, i == 1 ? 0.125 : 1.0, 0});
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
        strip.faces.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        strip.faces.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    const auto plain = tf::weld(strip, {}, {.tolerance = 0.25});
    CHECK(plain.mesh.points.size() == 7);
    CHECK(counts(plain.mesh).nonmanifold_points == 1);
    CHECK(weld(strip, 0.25).mesh.points.size() == 8);
    CHECK(weld(strip, 0.25).statistics.kept_apart == 1);

    tf::mesh end = strip;
    std::swap(end.points[1].y, end.points[3].y);  // now at the end of the strip
    CHECK(weld(end, 0.25).mesh.points.size() == 7);
    CHECK(weld(end, 0.25).statistics.kept_apart == 0);
}

TEST_CASE("keep_manifold: an edge that must not shrink keeps its equal corners joined") {
    // The strip above as triangles of their own: its points hold together, both ends stay.
    tf::mesh strip;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const double x = i;
        const double top = i == 1 ? 0.125 : 1.0;
        const double next = i == 0 ? 0.125 : 1.0;
        const tf::point3 corners[] = {{x, 0, 0}, {x + 1, 0, 0},    {x + 1, next, 0},
                                      {x, 0, 0}, {x + 1, next, 0}, {x, top, 0}};
        for (std::uint32_t k = 0; k < 6; k += 3) {
            const auto first = static_cast<std::uint32_t>(strip.points.size());
            strip.points.insert(strip.points.end(), corners + k, corners + k + 3);
            strip.faces.push_back({first, first + 1, first + 2});
        }
    }
    const auto welded = weld(strip, 0.25);
    CHECK(welded.mesh.points.size() == 8);
    CHECK(welded.statistics.kept_apart == 1);
    CHECK(welded.statistics.max_displacement == 0.0);
    CHECK(counts(welded.mesh).components_by_edge == 1);
}

TEST_CASE("keep_manifold: points without faces go with those that have some") {
    tf::mesh mesh = test::grid(1);
    mesh.points.insert(mesh.points.begin(), tf::point3{0, 0, 0});
    for (tf::face& f : mesh.faces)
        for (std::uint32_t& corner : f) ++corner;
    mesh.points.insert(mesh.points.end(), {{0, 0, 0}, {9, 9, 9}, {9, 9, 9}});
    const auto welded = weld(mesh);
    CHECK(welded.groups.group_of_point == ids{0, 0, 1, 2, 3, 0, 4, 4});
    CHECK(welded.statistics.kept_apart == 0);
    const tf::mesh cloud{std::vector<tf::point3>(5), {}};
    CHECK(weld(cloud).mesh.points.size() == 1);
}

TEST_CASE("keep_manifold: no edge and no point gets worse, on meshes that are bad enough already") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 10 + seed, 6 + seed, 3);
        for (const double tolerance : {0.0, 1.0}) {
            for (const bool chain : {false, true}) check_harmless(soup, tolerance, chain);
        }
        check_harmless(soup_of(soup), 1.0);
    }
}

TEST_CASE("keep_manifold: surfaces whose faces shrink stay surfaces") {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh sheet = test::grid(7);
        for (tf::point3& p : sheet.points) {
            p.x += source.in(-0.6, 0.6);
            p.y += source.in(-0.6, 0.6);
        }
        for (const double tolerance : {0.3, 0.7, 1.2}) {
            check_harmless(sheet, tolerance);
            check_harmless(soup_of(sheet), tolerance);
            const auto welded = weld(sheet, tolerance);
            CHECK(welded.statistics.nonmanifold_after == 0);
            CHECK(counts(welded.mesh).nonmanifold_points == 0);
            CHECK(welded.statistics.max_displacement <= 2 * tolerance);
        }
    }
}

TEST_CASE("keep_manifold: threads change nothing") {
    test::random source(3);
    tf::mesh sheet = test::grid(120);
    for (tf::point3& p : sheet.points) p.x += source.in(-0.6, 0.6);
    const tf::mesh soup = soup_of(sheet);
    const auto once = weld(soup, 0.7);
    CHECK(once.statistics.kept_apart > 0);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto again = weld(soup, 0.7);
        CHECK(again.mesh == once.mesh);
        CHECK(again.groups.group_of_point == once.groups.group_of_point);
        CHECK(again.statistics.kept_apart == once.statistics.kept_apart);
    }
}
