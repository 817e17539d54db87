#include <libmesh/base/double_double.hpp>
#include <treeform/mesh/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform {
namespace {

/// Coordinate k of what `by` makes of p.
detail::base::double_double moved_coordinate(const transform<3>& by, const point3& p,
                                             std::size_t k) {
    detail::base::double_double sum{by.rows[k][3], 0.0};
    for (std::size_t j = 0; j < 3; ++j) sum = sum + detail::base::product_of(by.rows[k][j], p[j]);
    return sum;
}

double displacement(const transform<3>& by, const point3& p, std::size_t k, double placed) {
    const detail::base::double_double exact = moved_coordinate(by, p, k);
    const double found = std::abs((placed - exact.high) - exact.low);
    if (!std::isnan(found)) return found;
    // Products overflow in halves before they do as a whole.
    const double plain = std::abs(placed - by(p)[k]);
    return std::isnan(plain) ? std::numeric_limits<double>::infinity() : plain;
}

}  // namespace

double max_displacement(points_view points, const transform<3>& by, points_view placed) {
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max(largest, displacement(by, points[i], k, placed[i][k]));
    return largest;
}

}  // namespace treeform
