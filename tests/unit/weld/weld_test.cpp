#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/extremes.hpp>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::infinity;
using test::not_a_number;
using test::vertex_columns;
using ids = std::vector<std::uint32_t>;

bool three_corners(const tf::face& f) { return f[0] != f[1] && f[1] != f[2] && f[2] != f[0]; }

bool within(const tf::point3& a, const tf::point3& b, double distance) {
    return tf::compare_distance(a, b, {}, {distance, 0.0, 0.0}) <= 0;
}

void check_faces(const tf::mesh& mesh, const tf::weld_result& welded) {
    std::uint64_t collapsed = 0;
    std::uint64_t degenerate = 0;
    std::vector<tf::face> faces;
    ids old;
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        tf::face f = mesh.faces[i];
        for (std::uint32_t& corner : f) corner = welded.groups.group_of_point[corner];
        if (!three_corners(mesh.faces[i])) ++degenerate;
        if (three_corners(mesh.faces[i]) && !three_corners(f)) ++collapsed;
        if (!three_corners(f)) continue;
        faces.push_back(f);
        old.push_back(i);
    }
    CHECK(welded.mesh.faces == faces);
    CHECK(welded.face_source == old);
    CHECK(welded.statistics.collapsed == collapsed);
    CHECK(welded.statistics.degenerate == degenerate);
}

void check_move(const tf::mesh& mesh, const tf::weld_result& welded) {
    bool reached = welded.statistics.max_displacement == 0.0;
    const double less = std::nextafter(welded.statistics.max_displacement, 0.0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const tf::point3& now = welded.mesh.points[welded.groups.group_of_point[i]];
        CHECK(within(mesh.points[i], now, welded.statistics.max_displacement));
        reached = reached || !within(mesh.points[i], now, less);
    }
    CHECK(reached);
}

/// What the header says of any result with `weld_keep::first`, by plain loops.
void check_result(const tf::mesh& mesh, const tf::weld_options& options) {
    const tf::weld_result welded = tf::weld(mesh, {}, options);
    const tf::point_groups groups = tf::group_points(mesh.points, options);
    CHECK(welded.groups.group_of_point == groups.group_of_point);
    CHECK(welded.groups.first_of_group == groups.first_of_group);
    CHECK(welded.vertex_source == groups.first_of_group);
    for (std::size_t g = 0; g < groups.first_of_group.size(); ++g)
        CHECK(welded.mesh.points[g] == mesh.points[groups.first_of_group[g]]);
    check_faces(mesh, welded);
    check_move(mesh, welded);
    const auto before = tf::count_topology(mesh.points.size(), mesh.faces);
    const auto after = tf::count_topology(welded.mesh.points.size(), welded.mesh.faces);
    CHECK(welded.statistics.nonmanifold_before == before.nonmanifold_edges);
    CHECK(welded.statistics.nonmanifold_after == after.nonmanifold_edges);
    std::uint64_t flipped = 0;
    for (std::size_t i = 0; i < welded.mesh.faces.size(); ++i) {
        const auto plane = [](const tf::mesh& m, const tf::face& f) {
            return tf::plane_points{m.points[f[0]], m.points[f[1]], m.points[f[2]]};
        };
        const tf::face& old = mesh.faces[welded.face_source[i]];
        const tf::face& now = welded.mesh.faces[i];
        flipped += tf::normal_dot(plane(mesh, old), plane(welded.mesh, now)) < 0 ? 1 : 0;
    }
    CHECK(welded.statistics.flipped == flipped);
    if (options.chain) return;
    const tf::weld_result again = tf::weld(welded.mesh, {}, options);
    CHECK(again.mesh == welded.mesh);
    CHECK(again.statistics.max_displacement == 0.0);
}

void check_same_weld(const tf::weld_result& a, const tf::weld_result& b) {
    CHECK(a.mesh == b.mesh);
    CHECK(a.attributes == b.attributes);
    CHECK(a.groups.group_of_point == b.groups.group_of_point);
    CHECK(a.vertex_source == b.vertex_source);
    CHECK(a.face_source == b.face_source);
    CHECK(a.statistics.collapsed == b.statistics.collapsed);
    CHECK(a.statistics.degenerate == b.statistics.degenerate);
    CHECK(a.statistics.max_displacement == b.statistics.max_displacement);
    CHECK(a.statistics.nonmanifold_before == b.statistics.nonmanifold_before);
    CHECK(a.statistics.nonmanifold_after == b.statistics.nonmanifold_after);
    CHECK(a.statistics.flipped == b.statistics.flipped);
    CHECK(a.statistics.kept_apart == b.statistics.kept_apart);
}

}  // namespace

TEST_CASE("weld: nothing comes of nothing, and one point of one") {
    const tf::weld_result none = tf::weld(tf::mesh{}, {}, {});
    CHECK(none.mesh == tf::mesh{});
    CHECK(none.groups.group_of_point.empty());
    CHECK(none.statistics.max_displacement == 0.0);
    for (const auto keep : {tf::weld_keep::first, tf::weld_keep::mean, tf::weld_keep::last}) {
        const tf::mesh one{{{1, 2, 3}}, {}};
        CHECK(tf::weld(one, {}, {.keep = keep, .only_borders = true}).mesh == one);
    }
}

TEST_CASE("weld: the triangles of a cube become eight points and stay twelve faces") {
    const tf::mesh_file cube = tf::read(test::data_folder() / "cube.stl");
    const auto welded = tf::weld(cube.mesh, cube.attributes, {});
    CHECK(welded.mesh.points.size() == 8);
    CHECK(welded.mesh.faces.size() == 12);
    CHECK(welded.statistics.collapsed + welded.statistics.degenerate == 0);
    CHECK(welded.statistics.max_displacement == 0.0);
    const auto counts = tf::count_topology(8, welded.mesh.faces);
    CHECK(counts.closed_manifold);
    CHECK(counts.misoriented_edges == 0);
}

TEST_CASE("weld: as its parts say on lattices, where points are equal and distances tie") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 60, 50, 5);
        for (const double tolerance : {0.0, 1.0, 1.5})
            for (const bool chain : {false, true})
                check_result(soup, {.tolerance = tolerance, .chain = chain});
    }
}

TEST_CASE("weld: as its parts say on random triangles of any size") {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::random_soup(source, 60, seed % 2 == 0 ? 0.3 : 0.01);
        for (const double tolerance : {0.0, 0.02, 0.2})
            for (const int exponent : {0, -1040, 900})
                check_result(test::scaled(soup, std::ldexp(1.0, exponent)),
                             {.tolerance = std::ldexp(tolerance, exponent)});
    }
}

TEST_CASE("weld: a face that turns over is counted, one that only tilts is not") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {1, -0.5, 0}, {1, 0.25, 0}, {4, 3, 0}},
                        {{0, 1, 3}, {0, 1, 4}}};
    const auto welded = tf::weld(mesh, {}, {.tolerance = 0.75});
    CHECK(welded.mesh.points.size() == 4);
    CHECK(welded.statistics.flipped == 1);
    CHECK(welded.statistics.max_displacement == 0.75);
}

TEST_CASE("weld: faces that repeat a corner are dropped, or kept when asked for") {
    const tf::mesh mesh{{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                        {{0, 1, 2}, {2, 2, 3}, {0, 2, 3}, {1, 2, 3}}};
    const auto welded = tf::weld(mesh, {}, {});
    CHECK(welded.statistics.collapsed == 1);
    CHECK(welded.statistics.degenerate == 1);
    CHECK(welded.face_source == ids{2, 3});
    CHECK(welded.mesh.faces == std::vector<tf::face>{{0, 1, 2}, {0, 1, 2}});

    const auto kept = tf::weld(mesh, {}, {.keep_degenerate = true});
    CHECK(kept.statistics.collapsed == 1);
    CHECK(kept.statistics.degenerate == 1);
    CHECK(kept.face_source == ids{0, 1, 2, 3});
    CHECK(kept.mesh.faces == std::vector<tf::face>{{0, 0, 1}, {1, 1, 2}, {0, 1, 2}, {0, 1, 2}});
}

TEST_CASE("weld: points that are not finite stay as they are and are not computed with") {
    const tf::mesh mesh{{{not_a_number, 0, 0},
                         {not_a_number, 0, 0},
                         {infinity, 0, 0},
                         {infinity, 0, 0},
                         {0, 0, 0},
                         {1, 0, 0}},
                        {{0, 4, 5}, {2, 4, 5}}};
    for (const auto keep : {tf::weld_keep::first, tf::weld_keep::mean, tf::weld_keep::last}) {
        const auto welded = tf::weld(mesh, {}, {.tolerance = 1.0, .keep = keep});
        CHECK(welded.groups.group_of_point == ids{0, 1, 2, 3, 4, 4});
        CHECK(std::isnan(welded.mesh.points[1].x));
        CHECK(welded.mesh.points[2].x == infinity);
        CHECK(welded.statistics.max_displacement == (keep == tf::weld_keep::mean ? 0.5 : 1.0));
        CHECK(welded.statistics.flipped == 0);
    }
}

TEST_CASE("weld: only borders are stitched when asked for") {
    tf::mesh sheets = test::together(test::grid(3), test::moved(test::grid(3), {3, 0, 0}));
    sheets.points.push_back({3, 0, 0});  // on the border of both, but of no face
    sheets.points.push_back({1, 1, 0});
    sheets.points[5] = {4, 0, 0};  // an inner point at a corner of the other sheet
    const auto all = tf::weld(sheets, {}, {});
    CHECK(all.mesh.points.size() == 28);
    const auto borders = tf::weld(sheets, {}, {.only_borders = true});
    CHECK(borders.mesh.points.size() == 30);
    CHECK(borders.groups.group_of_point[3] == borders.groups.group_of_point[16]);
    CHECK(borders.groups.group_of_point[5] == 5);
    CHECK(borders.groups.group_of_point[32] == 28);
    const tf::mesh cloud{std::vector<tf::point3>(4), {}};
    CHECK(tf::weld(cloud, {}, {.only_borders = true}).mesh.points.size() == 4);
}

TEST_CASE("weld: threads change nothing, nor does a scale by a power of two") {
    test::random source(5);
    const tf::mesh soup = test::random_soup(source, 70000, 0.02);
    std::vector<double> q(soup.points.size());
    for (double& x : q) x = static_cast<double>(source.below(3));
    const auto properties = vertex_columns({{"q", q}});
    for (const auto keep : {tf::weld_keep::first, tf::weld_keep::mean}) {
        const tf::weld_options options{
            .tolerance = 0.01, .same = {{"q"}}, .keep = keep, .only_borders = true};
        const auto once = tf::weld(soup, properties, options);
        CHECK(once.mesh.points.size() < soup.points.size());
        for (const unsigned threads : {1U, 2U, 8U}) {
            const tf::thread_scope scope(threads);
            check_same_weld(tf::weld(soup, properties, options), once);
        }
        tf::weld_options other = options;
        other.tolerance = std::ldexp(0.01, 40);
        const auto large = tf::weld(test::scaled(soup, 0x1p40), properties, other);
        CHECK(large.mesh == test::scaled(once.mesh, 0x1p40));
        CHECK(large.attributes == once.attributes);
        CHECK(large.statistics.max_displacement ==
              std::ldexp(once.statistics.max_displacement, 40));
        CHECK(large.statistics.flipped == once.statistics.flipped);
    }
}

TEST_CASE("weld: a search that is stopped leaves nothing but word of it") {
    const tf::mesh mesh = test::grid(2);
    const auto welded = tf::weld(mesh, {}, {.progress = [](double) { return false; }});
    CHECK(welded.status == tf::status::cancelled);
    CHECK(welded.mesh == tf::mesh{});
}

TEST_CASE("weld: what cannot be meant is refused by name") {
    const tf::mesh mesh = test::grid(1);
    const auto refused = [&](const tf::attributes& properties, const tf::weld_options& options,
                             const char* text) {
        CHECK_THROWS_WITH_AS((void)tf::weld(mesh, properties, options), text,
                             std::invalid_argument);
    };
    refused({}, {.same = {{"q"}}}, "treeform::weld: no vertex property 'q'");
    refused({}, {.keep = tf::weld_keep::lowest},
            "treeform::weld: keep lowest or highest needs keep_by, a property");
    refused({}, {.same = {{"xy"}}}, "treeform::weld: no vertex property 'xy'");
    for (const double bad : {-1.0, not_a_number, infinity})
        refused({}, {.same = {{"x", bad}}},
                "treeform::weld: the tolerance of 'x' must be finite and not negative");
    const ids label(3);
    refused({}, {.label = label, .same = {{"x"}}}, "treeform::weld: 3 labels for 4 points");
    tf::attributes properties = vertex_columns({{"q", {1, 2, 3}}});
    refused(properties, {}, "treeform::weld: element 'vertex' has 3 rows for 4 points");
    properties.elements[0].rows = 4;
    refused(properties, {}, "treeform::weld: column 'q' does not fit element 'vertex'");
    tf::attributes list;
    list.find_or_add("vertex", 4).columns = {
        {.name = "l", .list_length = tf::scalar_type::uint8, .list_begin = {0, 0, 0, 0, 0}}};
    refused(list, {.same = {{"l"}}}, "treeform::weld: the vertex property 'l' has lists of values");
    tf::attributes faces;
    faces.elements.push_back({.name = "face", .rows = 1});
    refused(faces, {}, "treeform::weld: element 'face' has 1 rows for 2 faces");
    CHECK_THROWS_WITH_AS((void)tf::weld(tf::mesh{mesh.points, {{0, 1, 2}, {1, 2, 9}}}, {}, {}),
                         doctest::Contains("treeform::weld: face 1 has a corner out of range"),
                         std::invalid_argument);
    CHECK_THROWS_AS((void)tf::weld(mesh, {}, {.tolerance = -1.0}), std::invalid_argument);
}
