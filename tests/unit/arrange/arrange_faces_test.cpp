/// \file
/// The arrangement of faces: what must hold of any complex, and the thread count.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace {

tf::point3 cross_product(const tf::point3& a, const tf::point3& b, const tf::point3& c) {
    const tf::point3 u{b.x - a.x, b.y - a.y, b.z - a.z};
    const tf::point3 v{c.x - a.x, c.y - a.y, c.z - a.z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

tf::mesh rounded(const tf::mesh_arrangement& cut) {
    tf::mesh mesh{cut.given_points, cut.faces};
    for (const tf::implicit_point& p : cut.constructed) mesh.points.push_back(tf::rounded(p));
    return mesh;
}

/// Checks that the pieces of every face have its area, and its direction.
void check_areas(const tf::mesh& mesh, const tf::arrange_faces_result& result) {
    const tf::mesh pieces = rounded(result.cut);
    std::vector<tf::point3> sums(mesh.faces.size());
    for (std::size_t f = 0; f < pieces.faces.size(); ++f) {
        const tf::face& c = pieces.faces[f];
        const tf::point3 n =
            cross_product(pieces.points[c[0]], pieces.points[c[1]], pieces.points[c[2]]);
        for (const tf::covering_face& cover : result.cut.covers_of(f)) {
            const double sign = cover.opposite ? -1.0 : 1.0;
            tf::point3& sum = sums[cover.face];
            sum = {sum.x + sign * n.x, sum.y + sign * n.y, sum.z + sign * n.z};
        }
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (std::binary_search(result.degenerate.begin(), result.degenerate.end(), f)) {
            CHECK(sums[f] == tf::point3{});
            continue;
        }
        const tf::face& c = mesh.faces[f];
        const tf::point3 n = cross_product(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]);
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(sums[f][k] == doctest::Approx(n[k]).epsilon(1e-9).scale(1.0));
    }
}

/// Checks that covers are ascending, that none is twice, and which is first.
void check_covers(const tf::mesh_arrangement& cut) {
    REQUIRE(cut.cover_begin.size() == cut.faces.size() + 1);
    std::uint32_t last = 0;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const auto covers = cut.covers_of(f);
        REQUIRE(!covers.empty());
        CHECK(!covers[0].opposite);
        CHECK(covers[0].face >= last);
        last = covers[0].face;
        for (std::size_t i = 1; i < covers.size(); ++i) CHECK(covers[i - 1].face < covers[i].face);
    }
}

/// The number of edges along which the pieces, taken as often as they cover, do not cancel.
std::size_t open_edges(const tf::mesh_arrangement& cut) {
    std::map<std::array<std::uint32_t, 2>, int> sums;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        int times = 0;
        for (const tf::covering_face& cover : cut.covers_of(f)) times += cover.opposite ? -1 : 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = cut.faces[f][i], v = cut.faces[f][(i + 1) % 3];
            sums[{std::min(u, v), std::max(u, v)}] += u < v ? times : -times;
        }
    }
    return static_cast<std::size_t>(
        std::ranges::count_if(sums, [](const auto& edge) { return edge.second != 0; }));
}

tf::mesh turned(tf::mesh mesh, double angle) {
    for (tf::point3& p : mesh.points) {
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y,
             std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
        p = {p.x, std::cos(angle) * p.y - std::sin(angle) * p.z,
             std::sin(angle) * p.y + std::cos(angle) * p.z};
    }
    return mesh;
}

}  // namespace

TEST_CASE("a mesh without contacts comes out as it is") {
    const tf::mesh mesh = test::ball(2, 1.0);
    const auto result = tf::arrange_faces(mesh);
    CHECK(result.cut.faces == mesh.faces);
    CHECK(result.cut.given_points == mesh.points);
    CHECK(result.cut.constructed.empty());
    CHECK(result.pairs == 0);
    CHECK(result.cut_faces == 0);
    CHECK(tf::arrange_faces({}).cut.faces.empty());
}

TEST_CASE("two crossing triangles are cut where they meet") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto result = tf::arrange_faces(mesh);
    // From (1, 1, 0) inside to (2, 2, 0) on the long side.
    CHECK(result.cut.constructed.size() == 2);
    CHECK(result.cut_faces == 2);
    CHECK(result.pairs == 1);
    check_areas(mesh, result);
    check_covers(result.cut);
    CHECK(tf::self_intersections(rounded(result.cut)).pairs.empty());
}

TEST_CASE("faces that overlap in a plane become one face where they do") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}},
                        {{0, 1, 2}, {3, 5, 4}}};
    const auto result = tf::arrange_faces(mesh);
    check_areas(mesh, result);
    check_covers(result.cut);
    CHECK(tf::self_intersections(rounded(result.cut)).pairs.empty());
    double both = 0.0;
    for (std::size_t f = 0; f < result.cut.faces.size(); ++f)
        if (result.cut.covers_of(f).size() == 2) {
            CHECK(result.cut.covers_of(f)[1] == tf::covering_face{1, true});
            const tf::mesh pieces = rounded(result.cut);
            const tf::face& c = pieces.faces[f];
            both += cross_product(pieces.points[c[0]], pieces.points[c[1]], pieces.points[c[2]]).z;
        }
    CHECK(both == 4.0);
}

TEST_CASE("equal faces and faces on each other's edges stay whole") {
    const tf::mesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
                        {{0, 1, 2}, {2, 1, 0}, {0, 3, 1}, {1, 2, 0}}};
    const auto result = tf::arrange_faces(mesh);
    REQUIRE(result.cut.faces.size() == 2);
    CHECK(result.cut.covers_of(0).size() == 3);
    CHECK(result.cut.constructed.empty());
}

TEST_CASE("boxes on a lattice are cut into a complex that holds in doubles") {
    test::random source(5);
    for (int round = 0; round < 60; ++round) {
        CAPTURE(round);
        tf::mesh mesh;
        const std::size_t boxes = 2 + source.below(4);
        for (std::size_t i = 0; i < boxes; ++i) {
            const auto whole = [&](std::size_t n) { return static_cast<double>(source.below(n)); };
            mesh = test::together(mesh,
                                  test::moved(test::box(1 + whole(3), 1 + whole(3), 1 + whole(3)),
                                              {whole(4), whole(4), whole(4)}));
        }
        mesh = tf::join_equal_points(mesh);
        const auto result = tf::arrange_faces(mesh);
        check_areas(mesh, result);
        check_covers(result.cut);
        CHECK(open_edges(result.cut) == 0);
    }
}

TEST_CASE("solids at any angle stay closed") {
    test::random source(6);
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        tf::mesh mesh = round % 2 == 0 ? test::box(1, 1, 1) : test::ball(2, 1.0);
        const std::size_t solids = 1 + source.below(4);
        for (std::size_t i = 0; i < solids; ++i)
            mesh = test::together(
                mesh,
                test::moved(turned(source.below(2) == 0 ? test::box(1, 2, 1) : test::ball(1, 1.0),
                                   source.in(0.0, 3.0)),
                            {source.unit(), source.unit(), source.unit()}));
        mesh = tf::join_equal_points(mesh);
        const auto result = tf::arrange_faces(mesh);
        check_areas(mesh, result);
        check_covers(result.cut);
        CHECK(open_edges(result.cut) == 0);
    }
}

TEST_CASE("soups of any faces keep their areas") {
    test::random source(7);
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        const tf::mesh mesh = tf::join_equal_points(
            round % 3 == 0   ? test::random_soup(source, 40, 0.4)
            : round % 3 == 1 ? test::lattice_soup(source, 25, 20, 3 + source.below(3))
                             : test::fan(source, 12));
        const auto result = tf::arrange_faces(mesh);
        check_areas(mesh, result);
        check_covers(result.cut);
    }
}

TEST_CASE("the arrangement does not depend on the number of threads") {
    test::random source(8);
    const tf::mesh mesh = test::random_soup(source, 300, 0.3);
    const auto all = tf::arrange_faces(mesh).cut;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto cut = tf::arrange_faces(mesh).cut;
        CHECK(cut.faces == all.faces);
        CHECK(cut.covers == all.covers);
        CHECK(rounded(cut) == rounded(all));
    }
}

TEST_CASE("what cannot be arranged is named") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    mesh.points[1].y = nan;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::arrange_faces(mesh)),
                         "treeform::arrange_faces: point 1 is not finite or beyond 2^1000",
                         std::invalid_argument);
    mesh.points[1].y = 0x1p1001;
    CHECK_THROWS_AS(static_cast<void>(tf::arrange_faces(mesh)), std::invalid_argument);
    mesh.points[1].y = 0.0;
    mesh.faces[0][2] = 3;
    CHECK_THROWS_AS(static_cast<void>(tf::arrange_faces(mesh)), std::invalid_argument);
}
