/// \file
/// Faces of four corners that are tetrahedra: recognized, and nothing else is.

#include <libmesh/repair/tetrahedra.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

using tetrahedron = std::array<std::uint32_t, 4>;
using tf::detail::repair::count_tetrahedra;

/// Each as a fan, as a reader makes triangles of a face of four corners.
tf::mesh as_faces(std::vector<tf::point3> points, const std::vector<tetrahedron>& all) {
    tf::mesh mesh{std::move(points), {}};
    for (const auto& [a, b, c, d] : all) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
    }
    return mesh;
}

/// n^3 cubes of six tetrahedra each, along the diagonal.
tf::mesh cut_up_cube(std::uint32_t n, bool inverted = false) {
    std::vector<tf::point3> points;
    const auto at = [n](std::array<std::uint32_t, 3> i) {
        return (i[0] * (n + 1) + i[1]) * (n + 1) + i[2];
    };
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t k = 0; k <= n; ++k)
                points.push_back(
                    {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
    std::vector<tetrahedron> all;
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::uint32_t cell = 0; cell < n * n * n; ++cell)
        for (std::size_t o = 0; o < orders.size(); ++o) {
            std::array<std::uint32_t, 3> i{cell / (n * n), cell / n % n, cell % n};
            tetrahedron t{at(i), 0, 0, 0};
            for (std::size_t step = 0; step < 3; ++step) {
                ++i[orders[o][step]];
                t[step + 1] = at(i);
            }
            if ((o < 3) == inverted) std::swap(t[2], t[3]);
            all.push_back(t);
        }
    return as_faces(std::move(points), all);
}

}  // namespace

TEST_CASE("tetrahedra: a cube that is cut up becomes its boundary, inverted or not") {
    for (const bool inverted : {false, true})
        for (const std::uint32_t n : {1U, 2U, 5U}) {
            const tf::mesh given = cut_up_cube(n, inverted);
            CHECK(count_tetrahedra(given) == 6 * n * n * n);
            CHECK(tf::find_solid_defects(given).tetrahedra == 6 * n * n * n);
            const tf::repair_result made = tf::repair(given);
            REQUIRE(made.certificate);
            CHECK(made.statistics.tetrahedra == 6 * n * n * n);
            CHECK(made.mesh.faces.size() == 12 * n * n);
            CHECK(made.statistics.removed == 0);
            CHECK(tf::signed_volume(made.mesh) == doctest::Approx(n * n * n));
            for (std::size_t f = 0; f < made.mesh.faces.size(); ++f) {
                const std::uint32_t t = made.face_source[f] / 2;  // its corners are of this one
                const auto& [a, b, c] = given.faces[2 * t];
                const std::uint32_t d = given.faces[2 * t + 1][2];
                for (const std::uint32_t corner : made.mesh.faces[f]) {
                    const std::uint32_t p = made.vertex_source[corner];
                    CHECK((p == a || p == b || p == c || p == d));
                }
            }
        }
}

TEST_CASE("tetrahedra: corners with equal coordinates are one") {
    const tf::repair_result made = tf::repair(test::unjoined(cut_up_cube(2)));
    REQUIRE(made.certificate);
    CHECK(made.statistics.tetrahedra == 48);
    CHECK(made.mesh.faces.size() == 48);
}

TEST_CASE("tetrahedra: two that share a face are some, one is not, nor two that share an edge") {
    const std::vector<tf::point3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    CHECK(count_tetrahedra(as_faces(points, {{0, 1, 2, 3}, {4, 2, 1, 3}})) == 2);
    CHECK(count_tetrahedra(as_faces(points, {{0, 1, 2, 3}})) == 0);
    CHECK(count_tetrahedra(as_faces(points, {{0, 1, 2, 3}, {4, 1, 2, 3}})) == 0);  // of two signs
    const std::vector<tf::point3> far{{0, 0, 0}, {1, 0, 0},  {0, 1, 0},
                                      {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
    CHECK(count_tetrahedra(as_faces(far, {{0, 1, 2, 3}, {0, 1, 4, 5}})) == 0);
}

TEST_CASE("tetrahedra: no volume mesh with a face less, one that is flat, or one there twice") {
    tf::mesh given = cut_up_cube(2);
    tf::mesh dirty = given;
    dirty.faces.pop_back();
    CHECK(count_tetrahedra(dirty) == 0);
    dirty = given;
    std::swap(dirty.faces[3], dirty.faces[4]);
    CHECK(count_tetrahedra(dirty) == 0);
    dirty = given;
    dirty.points[13] = {0, 0, 0};  // the middle one
    CHECK(count_tetrahedra(dirty) == 0);
    dirty = given;
    dirty.faces.push_back(given.faces[0]);
    dirty.faces.push_back(given.faces[1]);
    CHECK(count_tetrahedra(dirty) == 0);
}

TEST_CASE("tetrahedra: surfaces of faces with four corners are none") {
    CHECK(count_tetrahedra(test::box(1, 1, 1)) == 0);
    CHECK(count_tetrahedra(test::grid(6)) == 0);
    CHECK(count_tetrahedra(test::ball(2, 1.0)) == 0);
    // A saddle, each face of which is folded the same way.
    tf::mesh saddle = test::grid(6);
    for (tf::point3& p : saddle.points) p.z = p.x * p.y;
    CHECK(count_tetrahedra(saddle) == 0);
    // Three folded faces around two points close a solid, which stays as it is.
    const tf::mesh closed = as_faces({{0, 0, 1}, {0, 0, -1}, {2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}},
                                     {{2, 1, 3, 0}, {3, 1, 4, 0}, {4, 1, 2, 0}});
    const tf::repair_result made = tf::repair(closed);
    REQUIRE(made.certificate);
    CHECK(made.statistics.tetrahedra == 0);
}
