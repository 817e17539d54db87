#pragma once
/// \file
/// Where a shape is put: turned, moved, scaled, and rounded to float.

#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/mesh.hpp>

#include <support/stress_parts.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace treeform::test {

/// Rows; takes a point to its turned place.
using turn_rows = std::array<point3, 3>;

struct placement {
    turn_rows turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    point3 away{};       ///< after turning
    double scale = 1.0;  ///< after moving
    bool single = false;
};

/// `x` rounded to float, unless no float is so large.
inline double as_float(double x) {
    return std::abs(x) > std::numeric_limits<float>::max() ? x : detail::base::nearest_float(x);
}

inline point3 placed(const point3& p, const placement& where) {
    using namespace stress;
    const auto row = [&](const point3& r) { return r.x * p.x + r.y * p.y + r.z * p.z; };
    const point3 turned{row(where.turn[0]), row(where.turn[1]), row(where.turn[2])};
    const point3 q = where.scale * (turned + where.away);
    return where.single ? point3{as_float(q.x), as_float(q.y), as_float(q.z)} : q;
}

inline mesh placed(mesh shape, const placement& where) {
    for (point3& p : shape.points) p = placed(p, where);
    return shape;
}

/// The rotation of a quaternion; orthogonal up to rounding.
inline turn_rows rotation(double w, double x, double y, double z) {
    const double s = 2 / (w * w + x * x + y * y + z * z);
    return {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
             {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
             {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

inline turn_rows random_rotation(random_source& random) {
    const double w = random.unit() + 0x1p-10;
    const double x = random.unit() - 0.5;
    const double y = random.unit() - 0.5;
    return rotation(w, x, y, random.unit() - 0.5);
}

inline turn_rows random_exchange_of_axes(random_source& random) {
    turn_rows rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::swap(rows[0], rows[random.below(3)]);
    std::swap(rows[1], rows[1 + random.below(2)]);
    return rows;
}

/// Half the time exact up to the translation: axes exchanged, a scale by a power of two.
inline placement random_placement(random_source& random) {
    constexpr std::array<double, 5> distances{0, 1, 1e3, 1e6, 1e9};
    placement where;
    const bool exact = random.one_in(2);
    where.single = random.one_in(2);
    where.turn = exact ? random_exchange_of_axes(random) : random_rotation(random);
    where.scale = exact ? std::ldexp(1.0, static_cast<int>(random.below(201)) - 100)
                        : stress::power_of_ten(static_cast<int>(random.below(61)) - 30);
    const double distance = distances[random.below(distances.size())];
    using stress::operator*;
    where.away = distance * stress::lattice_point(random, -1, 1);
    return where;
}

struct named_placement {
    std::string name;
    placement where;
};

/// The placements that every family is tried in, one thing changed in each.
inline std::vector<named_placement> named_placements() {
    const auto by = [](double d) { return placement{.away = {d, -d, d}}; };
    return {{"plain", {}},
            {"turned", {.turn = rotation(0.9, 0.3, -0.2, 0.1)}},
            {"by-1", by(1)},
            {"by-1e3", by(1e3)},
            {"by-1e6", by(1e6)},
            {"by-1e9", by(1e9)},
            {"times-1e-30", {.scale = 1e-30}},
            {"times-1e30", {.scale = 1e30}}};
}

}  // namespace treeform::test
