/// \file
/// Tetrahedra that fill a box: oriented, linked both ways, and of the box's volume, wherever points
/// lie.

#include <libmesh/wrap/tetrahedralization.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using tf::detail::wrap::tetrahedralization;
constexpr std::uint32_t none = tetrahedralization::none;

/// Six times the volume of a tetrahedron with small whole coordinates: exact.
double volume(const std::array<tf::point3, 4>& t) {
    std::array<std::array<double, 3>, 3> v{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) v[i][k] = t[i + 1][k] - t[0][k];
    return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
           v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

void check_links(const tetrahedralization& all) {
    std::size_t used = 0;
    for (std::uint32_t t = 0; t < all.size(); ++t) {
        if (!all.is_used(t)) continue;
        ++used;
        const auto [a, b, c, d] = all.corners(t);
        CHECK(tf::orient3d(a, b, c, d) == 1);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t next = all[t].neighbors[i];
            if (next == none) continue;
            REQUIRE(all.is_used(next));
            const auto& back = all[next].neighbors;
            const auto j =
                static_cast<std::size_t>(std::find(back.begin(), back.end(), t) - back.begin());
            REQUIRE(j < 4);
            std::array<std::uint32_t, 3> mine = all.face(t, i);
            std::array<std::uint32_t, 3> theirs = all.face(next, j);
            std::sort(mine.begin(), mine.end());
            std::sort(theirs.begin(), theirs.end());
            CHECK(mine == theirs);
        }
    }
    CHECK(used == all.count());
}

double volume_of(const tetrahedralization& all) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < all.size(); ++t)
        if (all.is_used(t)) sum += volume(all.corners(t));
    return sum;
}

/// Points of a lattice in (0, 64)^3, so that volumes are exact: many on faces, edges and spheres.
void check_lattice(std::uint64_t seed, std::size_t side) {
    test::random source(seed);
    const double step = 64.0 / static_cast<double>(side);
    tetrahedralization all({{0, 0, 0}, {64, 64, 64}});
    std::set<std::array<std::size_t, 3>> known;
    for (std::size_t n = 0; n < 600; ++n) {
        std::array<std::size_t, 3> at{};
        for (std::size_t& k : at) k = 1 + source.below(side - 1);
        const tf::point3 p{step * static_cast<double>(at[0]), step * static_cast<double>(at[1]),
                           step * static_cast<double>(at[2])};
        std::uint32_t near = static_cast<std::uint32_t>(source.below(all.size()));
        while (!all.is_used(near)) near = (near + 1) % static_cast<std::uint32_t>(all.size());
        CHECK(all.insert(p, near, 0.0) == known.insert(at).second);
    }
    CHECK(all.points().size() == 8 + known.size());
    check_links(all);
    CHECK(volume_of(all) == 6.0 * 64 * 64 * 64);
    std::set<std::uint32_t> corners;
    for (std::uint32_t t = 0; t < all.size(); ++t)
        if (all.is_used(t)) corners.insert(all[t].corners.begin(), all[t].corners.end());
    CHECK(corners.size() == all.points().size());
}

}  // namespace

TEST_CASE("six tetrahedra fill a box") {
    const tetrahedralization all({{0, 0, 0}, {64, 64, 64}});
    CHECK(all.count() == 6);
    check_links(all);
    CHECK(volume_of(all) == 6.0 * 64 * 64 * 64);
}

TEST_CASE("points of a coarse lattice, of a fine one, and each again") {
    for (const std::size_t side : std::array<std::size_t, 4>{4, 8, 16, 64})
        for (std::uint64_t seed = 0; seed < 5; ++seed) check_lattice(seed, side);
}

TEST_CASE("a point on a face of the box, or outside, or too near, changes nothing") {
    tetrahedralization all({{0, 0, 0}, {64, 64, 64}});
    REQUIRE(all.insert({32, 32, 32}, 0, 0.0));
    const auto is_refused = [&](const tf::point3& p, double apart) {
        const std::size_t before = all.count();
        std::uint32_t near = 0;
        while (!all.is_used(near)) ++near;
        CHECK_FALSE(all.insert(p, near, apart));
        CHECK(all.count() == before);
        CHECK(all.points().size() == 9);
        check_links(all);
    };
    is_refused({32, 32, 0}, 0.0);
    is_refused({32, 32, -1}, 0.0);
    is_refused({100, 32, 5}, 0.0);
    is_refused({32, 32, 32}, 0.0);
    is_refused({32, 32, 33}, 1.5);
    CHECK(all.insert({32, 32, 33}, all.made()[0], 1.0));
}

TEST_CASE("points of a sphere, in doubles, next to its center") {
    // All circumspheres are nearly one, so that what they tell is mostly rounding.
    test::random source(7);
    tetrahedralization all({{-2, -2, -2}, {2, 2, 2}});
    REQUIRE(all.insert({0, 0, 0}, 0, 0.0));
    for (std::size_t n = 0; n < 2000; ++n) {
        tf::point3 p{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        p = {p.x / length, p.y / length, p.z / length};
        CHECK(all.insert(p, all.made()[0], 0.0));
    }
    check_links(all);
    CHECK(volume_of(all) == doctest::Approx(6.0 * 64));
}
