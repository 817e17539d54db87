#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/round/turned_faces.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::together;

using ids = std::vector<std::uint32_t>;

ids all_faces(const tf::mesh& mesh) {
    ids all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

ids turned_faces(const tf::mesh& mesh, const tf::detail::round::winding_of_rest& rest = {}) {
    const ids near = all_faces(mesh);
    return tf::detail::round::find_turned_faces(mesh, {mesh, near}, rest);
}

/// The faces that have other cells than the outside in front and what is once inside behind.
ids turned_by_cells(const tf::mesh& mesh) {
    const tf::mesh_arrangement cut = tf::arrange_faces(mesh).cut;
    const tf::arrangement_cells cells = tf::find_cells(mesh, cut, ids(mesh.faces.size(), 0), 1);
    ids turned;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [front, behind] = cells.cell_of_side[f];
        if (cells.winding[front] != 0 || cells.winding[behind] != 1) turned.push_back(f);
    }
    return turned;
}

double to_float(double x) {
    const volatile auto rounded = static_cast<float>(x);
    return rounded;
}

tf::mesh in_floats(tf::mesh mesh) {
    for (tf::point3& p : mesh.points) p = {to_float(p.x), to_float(p.y), to_float(p.z)};
    return mesh;
}

bool has_equal_points(const tf::mesh& mesh) {
    std::vector<tf::point3> points = mesh.points;
    const auto less = [](const tf::point3& p, const tf::point3& q) {
        return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
    };
    std::sort(points.begin(), points.end(), less);
    return std::adjacent_find(points.begin(), points.end()) != points.end();
}

}  // namespace

TEST_CASE("turned: of shells in each other, those that face the wrong way") {
    for (const double size : {1.0, 0x1p-140, 0x1p140}) {
        CAPTURE(size);
        const tf::mesh cube = box(size, size, size);
        const tf::mesh small =
            moved(box(0.5 * size, 0.5 * size, 0.5 * size), {0.25 * size, 0.25 * size, 0.25 * size});
        CHECK(turned_faces(cube).empty());
        CHECK(turned_faces(test::inside_out(cube)) == all_faces(cube));
        CHECK(turned_faces(together(cube, test::inside_out(small))).empty());
        const tf::mesh twice = together(cube, small);
        CHECK(turned_faces(twice) == turned_by_cells(twice));
        CHECK(turned_faces(twice).size() == small.faces.size());
    }
    CHECK(turned_faces({}).empty());
}

TEST_CASE("turned: faces that are left out count, and hold what they are at") {
    const tf::mesh small = moved(box(0.5, 0.5, 0.5), {0.25, 0.25, 0.25});
    const tf::mesh hole = test::inside_out(small);
    const auto in_a_cube = [](const tf::detail::arrange::corner_line&, bool) { return 1; };
    CHECK(turned_faces(hole) == all_faces(hole));
    CHECK(turned_faces(hole, in_a_cube).empty());
    CHECK(turned_faces(small, in_a_cube) == all_faces(small));
    tf::mesh rest = hole;
    rest.faces.pop_back();
    CHECK(turned_faces(rest).empty());
}

TEST_CASE("turned: parts that end at edges of four faces are told of together") {
    // A box with a pointed bottom stands on the rim of a hole of its size: bottom and sides meet at
    // that rim only.
    const tf::mesh far = moved(box(1, 1, 1), {9, 9, 9});
    tf::mesh pointed = box(1, 1, 1);
    pointed.faces.erase(pointed.faces.begin(), pointed.faces.begin() + 2);
    pointed.points.push_back({0.5, 0.5, -0.5});
    pointed.faces.insert(pointed.faces.end(), {{0, 2, 8}, {2, 3, 8}, {3, 1, 8}, {1, 0, 8}});
    tf::mesh standing = together(far, pointed);
    const auto b = static_cast<std::uint32_t>(far.points.size());
    for (const double z : {0.0, -1.0})
        for (const double side : {-1.0, 2.0})
            for (const double other : {-1.0, 2.0}) standing.points.push_back({side, other, z});
    for (const double side : {0.0, 1.0})
        for (const double other : {0.0, 1.0}) standing.points.push_back({side, other, -1});
    // Corners of the hole at z = 0, of the plate there, of the plate below, of the hole below.
    const std::array<std::uint32_t, 4> hole{b, b + 1, b + 3, b + 2};
    const std::array<std::uint32_t, 4> top{b + 9, b + 11, b + 12, b + 10};
    const std::array<std::uint32_t, 4> bottom{b + 13, b + 15, b + 16, b + 14};
    const std::array<std::uint32_t, 4> below{b + 17, b + 19, b + 20, b + 18};
    const auto wall = [&](const auto& from, const auto& to) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t j = (i + 1) % 4;
            standing.faces.push_back({from[i], from[j], to[j]});
            standing.faces.push_back({from[i], to[j], to[i]});
        }
    };
    wall(top, hole);
    wall(hole, below);
    wall(below, bottom);
    wall(bottom, top);
    REQUIRE(tf::self_intersections(standing).pairs.empty());
    CHECK(turned_by_cells(standing).empty());
    CHECK(turned_faces(standing).empty());
}

TEST_CASE("turned: lines tell what cells do, of what rounding has moved") {
    std::size_t whole = 0, turned = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh far = moved(box(1, 1, 1), {9, 9, 9});
        tf::mesh exact = far;
        for (int i = 0; i < 2; ++i) {  // the fourth corner is about as far as what floats show
            const auto anywhere = [&] {
                return tf::point3{source.unit(), source.unit(), source.unit()};
            };
            tf::mesh flat{{anywhere(), anywhere(), anywhere()},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
            const double up =
                std::ldexp(source.in(-1, 1), -10 - static_cast<int>(source.below(16)));
            const auto middle = [&](std::size_t k) {
                return (flat.points[0][k] + flat.points[1][k] + flat.points[2][k]) / 3;
            };
            flat.points.push_back({middle(0), middle(1), middle(2) + up});
            if (tf::signed_volume(flat) < 0) flat = test::inside_out(flat);
            exact = together(exact, flat);
        }
        const tf::mesh rounded = in_floats(exact);
        if (has_equal_points(rounded) || !tf::self_intersections(rounded).pairs.empty()) continue;
        const ids found = turned_faces(rounded);
        CHECK(found == turned_by_cells(rounded));
        ++(found.empty() ? whole : turned);
    }
    CHECK(whole > 20);
    CHECK(turned > 20);
}
