#pragma once
/// \file
/// Limits and state of the rounds of `round_surface`, and the displacement of points by rounding.

#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::round {

/// Limits of the rounds.
struct rounding_rounds {
    double reach;          ///< largest distance of joined elements, at first
    double limit;          ///< the same at the end
    double height;         ///< height below which faces are slivers
    std::uint64_t visits;  ///< limit of the pairs of faces tested to remove slivers
};

/// The state that a round changes before it cuts.
struct rounding_state {
    mesh surface;
    std::vector<std::uint32_t> face_of, point_of;
    std::vector<std::uint8_t> certified;
    std::vector<face_pair> pairs;
    treeform::certificate certificate;
    double joined;
    std::uint64_t slivers;
    int rounds;
};

inline point3 to_single(const point3& p) {
    return {base::nearest_float(p.x), base::nearest_float(p.y), base::nearest_float(p.z)};
}

inline double largest_difference(const point3& p, const point3& q) {
    return base::largest_of(base::minus(p, q));
}

/// Half a unit in the last place of the largest coordinate: the largest displacement by rounding to
/// nearest.
inline double half_unit(const point3& p) {
    const double largest = base::largest_of(p);
    const double unit = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
    return std::max(unit / 2, std::numeric_limits<double>::denorm_min());  // whose half is 0
}

}  // namespace treeform::detail::round
