#include <libmesh/base/double_double.hpp>
#include <libmesh/base/max_displacement.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

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

double detail::max_displacement(points_view points, const transform<3>& by, points_view placed) {
    std::vector<double> largest(chunk_count(points.size(), light_grain), 0.0);
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        double mine = 0.0;
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                mine = std::max(mine, displacement(by, points[i], k, placed[i][k]));
        largest[c] = mine;
    });
    return std::accumulate(largest.begin(), largest.end(), 0.0,
                           [](double a, double b) { return std::max(a, b); });
}

}  // namespace treeform
