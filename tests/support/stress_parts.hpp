#pragma once
/// \file
/// What the families of hard pairs and of hard meshes are made of: points and triangles drawn in an
/// order that the language fixes, by operations that every machine rounds alike.

#include <treeform/mesh/predicates.hpp>

#include <support/stress_random.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace treeform::test::stress {

inline point3 operator+(const point3& p, const point3& q) {
    return {p.x + q.x, p.y + q.y, p.z + q.z};
}
inline point3 operator-(const point3& p, const point3& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
}
inline point3 operator*(double s, const point3& p) { return {s * p.x, s * p.y, s * p.z}; }
inline point3 cross(const point3& p, const point3& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

/// By repeated multiplication, since std::pow may differ in the last bit.
inline double power_of_ten(int exponent) {
    double result = 1.0;
    for (int i = 0; i < std::abs(exponent); ++i) result *= 10.0;
    return exponent < 0 ? 1.0 / result : result;
}

template <class Change>
triangle3 changed(const triangle3& t, Change change) {
    return {change(t[0]), change(t[1]), change(t[2])};
}

inline point3 random_point(random_source& random) {
    return {random.unit(), random.unit(), random.unit()};
}
inline triangle3 random_triangle(random_source& random) {
    return {random_point(random), random_point(random), random_point(random)};
}
inline point3 lattice_point(random_source& random, int low, int high) {
    return {random.whole(low, high), random.whole(low, high), random.whole(low, high)};
}
inline triangle3 lattice_triangle(random_source& random, int low, int high) {
    return {lattice_point(random, low, high), lattice_point(random, low, high),
            lattice_point(random, low, high)};
}
/// Coordinates of 10 bits, so that points with small dyadic weights are exact.
inline triangle3 dyadic_triangle(random_source& random) {
    return changed(lattice_triangle(random, 0, 1024), [](const point3& p) { return 0x1p-10 * p; });
}

/// A point of the plane of `t`: half the time with weights of whole eighths, which are exact for
/// dyadic corners and often lie on an edge or a corner, else with any weights.
inline point3 point_on_plane(const triangle3& t, random_source& random) {
    const bool eighths = random.one_in(2);
    const auto weight = [&] {
        return eighths ? random.whole(-2, 10) / 8 : 1.25 * random.unit() - 0.125;
    };
    const double u = weight();
    const double v = weight();
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

/// A corner, a point of an edge, or any point of the closed triangle.
inline point3 point_of(const triangle3& t, random_source& random) {
    const std::size_t i = random.below(3);
    const point3& p = t[i];
    const point3& q = t[(i + 1) % 3];
    const double u = random.whole(1, 7) / 8;
    switch (random.below(3)) {
        case 0:
            return p;
        case 1:
            return p + u * (q - p);
        default:
            return p + u * (q - p) + (1 - u) / 2 * (t[(i + 2) % 3] - p);
    }
}

inline point3 moved_by_ulps(point3 p, int ulps, random_source& random) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double toward = random.one_in(2) ? infinity : -infinity;
        const auto steps = random.below(static_cast<std::uint64_t>(ulps) + 1);
        for (std::uint64_t i = 0; i < steps; ++i) p[axis] = std::nextafter(p[axis], toward);
    }
    return p;
}

/// With three digits behind the point, as many programs write.
inline point3 with_three_digits(const point3& p) {
    const auto digits = [](double x) { return std::round(1000 * x) / 1000; };
    return {digits(p.x), digits(p.y), digits(p.z)};
}

/// A number from the ends of the range or from its middle, or a zero of either sign.
inline double extreme_coordinate(double unit, random_source& random) {
    const double x = random.whole(-3, 3) * unit;
    return x == 0.0 && random.one_in(2) ? -0.0 : x;
}
inline constexpr double extreme_units[] = {0x1p-1074, 0x1p-1023, 1e-310, 1e-150, 1.0, 1e150, 1e300};

}  // namespace treeform::test::stress
