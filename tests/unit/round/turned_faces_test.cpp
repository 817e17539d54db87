#include <libmesh/round/turned_faces.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace {

using test::box;
using test::infinity;
using test::moved;
using test::together;

std::vector<std::uint32_t> all_faces(const tf::mesh& mesh) {
    std::vector<std::uint32_t> all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

/// All faces are near ones; those before `first_moved` have not moved.
bool may_be_turned(const tf::mesh& mesh, std::size_t first_moved, double by) {
    std::vector<std::uint8_t> sound(mesh.faces.size(), 0);
    std::fill_n(sound.begin(), first_moved, std::uint8_t{1});
    const std::vector<std::uint32_t> near = all_faces(mesh);
    return tf::detail::round::may_be_turned(mesh, sound, {mesh, near}, by);
}

double to_float(double x) {
    const volatile auto rounded = static_cast<float>(x);
    return rounded;
}

tf::mesh in_floats(tf::mesh mesh) {
    for (tf::point3& p : mesh.points) p = {to_float(p.x), to_float(p.y), to_float(p.z)};
    return mesh;
}

double largest_move(const tf::mesh& a, const tf::mesh& b) {
    double most = 0.0;
    for (std::size_t p = 0; p < a.points.size(); ++p)
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max(most, std::abs(a.points[p][k] - b.points[p][k]));
    return most;
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

TEST_CASE("turned: a loose part is as before as long as its points moved little for its volume") {
    for (const double size : {1.0, 0x1p-140, 0x1p140}) {
        CAPTURE(size);
        const tf::mesh far = box(size, size, size);
        const std::size_t still = far.faces.size();
        const tf::mesh cube = together(far, moved(box(size, size, size), {3 * size, 0, 0}));
        CHECK_FALSE(may_be_turned(cube, still, 1e-3 * size));
        CHECK(may_be_turned(cube, still, 0.5 * size));
        CHECK(may_be_turned(cube, still, infinity));
        const tf::mesh hollow =
            together(cube, test::inside_out(moved(box(0.5 * size, 0.5 * size, 0.5 * size),
                                                  {3.25 * size, 0.25 * size, 0.25 * size})));
        CHECK_FALSE(may_be_turned(hollow, still, 1e-3 * size));
        const tf::mesh plate = together(far, moved(box(size, size, 1e-9 * size), {3 * size, 0, 0}));
        CHECK_FALSE(may_be_turned(plate, still, 1e-11 * size));
        CHECK(may_be_turned(plate, still, 0.5e-9 * size));
    }
}

TEST_CASE("turned: of a part without a volume, or of one that is too large, nothing is told") {
    const tf::mesh far = moved(box(1, 1, 1), {-3, 0, 0});
    for (const double size : {0x1p-400, 0x1p160})
        CHECK(may_be_turned(together(far, box(size, size, size)), far.faces.size(), 0x1p-1000));
    tf::mesh flat = together(far, moved(box(1, 1, 1), {3, 0, 0}));
    for (std::size_t p = far.points.size(); p < flat.points.size(); ++p) flat.points[p].z = 0.3;
    CHECK(may_be_turned(flat, far.faces.size(), 0x1p-1000));
}

TEST_CASE("turned: a part that another may have passed is looked at, whether it has moved or not") {
    // A small box in the box of a large face that moves, and next to none of its corners.
    const tf::mesh far = moved(box(1, 1, 1), {9, 9, 9});
    const tf::mesh small = moved(box(1e-3, 1e-3, 1e-3), {0.5, 0.5, 0.5});
    tf::mesh large;
    large.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    large.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    large = moved(large, {-0.2, -0.2, -0.2});
    tf::mesh slope = together(far, together(test::inside_out(small), large));
    const std::size_t unmoved = far.faces.size() + small.faces.size();
    CHECK(may_be_turned(slope, unmoved, 1e-12));
    CHECK(may_be_turned(slope, far.faces.size(), 1e-12));
    // Beside that box, there is nothing to tell.
    slope = together(far, together(moved(small, {-1, 0, 0}), large));
    CHECK_FALSE(may_be_turned(slope, unmoved, 1e-12));
    CHECK_FALSE(may_be_turned(slope, far.faces.size(), 1e-12));
}

TEST_CASE("turned: a part that ends at edges of four faces is not loose by itself") {
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
    REQUIRE(tf::detail::round::find_turned_faces(standing).faces.empty());
    CHECK(may_be_turned(standing, far.faces.size(), 1e-12));
}

TEST_CASE("turned: where nothing is said to be turned, cells find nothing turned") {
    std::size_t told = 0, turned = 0;
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
        if (!tf::self_intersections(exact).pairs.empty() ||
            !tf::detail::round::find_turned_faces(exact).faces.empty() ||
            has_equal_points(rounded) || !tf::self_intersections(rounded).pairs.empty())
            continue;
        const bool any = !tf::detail::round::find_turned_faces(rounded).faces.empty();
        const bool said = may_be_turned(rounded, far.faces.size(), largest_move(exact, rounded));
        CHECK((said || !any));
        told += said ? 0 : 1;
        turned += any ? 1 : 0;
    }
    CHECK(told > 20);
    CHECK(turned > 20);
}
