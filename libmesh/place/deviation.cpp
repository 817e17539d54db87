#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/point_sides.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t points_per_slice = std::size_t{1} << 16;

void check_deviation(const deviation_options& o) {
    if (o.bins > (std::size_t{1} << 20))
        throw std::invalid_argument("treeform::deviation: more than 2^20 bins");
    if (o.band && !((*o.band)[0] <= (*o.band)[1]))
        throw std::invalid_argument(
            "treeform::deviation: the band is NaN, or its first value is above the second");
}

/// What was found for points, in an order of space.
struct ordered_distances {
    std::vector<std::uint32_t> order;  ///< number of the point at each place
    std::vector<point3> points;
    std::vector<double> distance;
    std::vector<std::uint32_t> face;
};

/// Empty answers when it is to stop. \pre `surface` has faces
ordered_distances distances_to(const prepared_mesh& surface, points_view points,
                               detail::base::work_progress& work, double begin, double end) {
    ordered_distances found;
    found.order = detail::morton_order<3>(points.size(), [&](std::size_t i) {
        return std::array<double, 3>{points[i].x, points[i].y, points[i].z};
    });
    found.points.reserve(points.size());
    for (const std::uint32_t i : found.order) found.points.push_back(points[i]);
    found.distance.resize(points.size());
    found.face.resize(points.size());
    const auto& query = detail::nearness::closest_point_query_of(surface);
    const std::vector<double> radii(std::min(points.size(), points_per_slice),
                                    std::numeric_limits<double>::infinity());
    for (std::size_t from = 0; from < points.size(); from += points_per_slice) {
        const std::size_t count = std::min(points_per_slice, points.size() - from);
        const auto near = query.nearest_in_order(std::span(found.points).subspan(from, count),
                                                 std::span(radii).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            found.distance[from + i] = near[i]->distance;
            found.face[from + i] = near[i]->face;
        }
        const double share = static_cast<double>(from + count) / static_cast<double>(points.size());
        if (!work.reach(begin + (end - begin) * share)) return {};
    }
    return found;
}

double largest_in(points_view points) {
    double largest = 0.0;
    for (const point3& p : points) largest = std::max(largest, detail::base::largest_of(p));
    return largest;
}

/// The largest of these magnitudes.
double largest_of(std::span<const double> distances) {
    double largest = 0.0;
    for (const double d : distances) largest = std::max(largest, std::abs(d));
    return largest;
}

/// Bound of the distance of any point of a surface with these distances at its points.
double bound_of(mesh_view of, std::span<const double> distances) {
    double bound = largest_of(distances);
    std::vector<double> most(chunk_count(of.faces.size(), light_grain));
    for_chunks(of.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t f = begin; f < end; ++f) {
                       double corner = 0.0, edge = 0.0;
                       for (std::size_t i = 0; i < 3; ++i) {
                           const std::uint32_t p = of.faces[f][i], q = of.faces[f][(i + 1) % 3];
                           const point3 e = detail::base::minus(of.points[q], of.points[p]);
                           corner = std::max(corner, std::abs(distances[p]));
                           edge = std::max(edge, std::hypot(e.x, e.y, e.z));
                       }
                       // With weights w of the corners v of a point x, and the center c of a ball
                       // of radius r around them, sum w |x - v|^2 <= sum w |c - v|^2 <= r^2: some
                       // corner is within r. By Jung's theorem r <= the longest edge / sqrt(3).
                       most[chunk] = std::max(most[chunk], corner + edge * 0.5773502691896259);
                   }
               });
    for (const double one : most) bound = std::max(bound, one * (1.0 + 0x1p-48));
    return bound;
}

/// The least of these magnitudes that a share of them do not exceed. Changes their order.
double percentile(std::vector<double>& magnitudes, double share) {
    const auto count = static_cast<double>(magnitudes.size());
    const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * count)));
    const auto at = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(magnitudes.begin(), at, magnitudes.end());
    return *at;
}

void enter_moments(deviation_result& r) {
    std::vector<double> magnitudes;
    magnitudes.reserve(r.distances.size());
    for (const double d : r.distances) magnitudes.push_back(std::abs(d));
    const auto worst = std::max_element(magnitudes.begin(), magnitudes.end());
    r.worst = static_cast<std::uint32_t>(worst - magnitudes.begin());
    r.max = *worst;
    // In units of the largest, so that nothing overflows.
    const double unit = r.max > 0.0 ? r.max : 1.0;
    double sum = 0.0, absolute = 0.0, squares = 0.0;
    for (std::size_t begin = 0; begin < r.distances.size(); begin += light_grain) {
        double part = 0.0, part_absolute = 0.0, part_squares = 0.0;
        const std::size_t end = std::min(r.distances.size(), begin + light_grain);
        for (std::size_t i = begin; i < end; ++i) {
            const double d = r.distances[i] / unit;
            part += d;
            part_absolute += std::abs(d);
            part_squares += d * d;
        }
        sum += part;
        absolute += part_absolute;
        squares += part_squares;
    }
    const auto count = static_cast<double>(r.distances.size());
    r.mean = sum / count * unit;
    r.mean_absolute = absolute / count * unit;
    r.rms = std::sqrt(squares / count) * unit;
    const auto [lowest, highest] = std::minmax_element(r.distances.begin(), r.distances.end());
    r.lowest = *lowest;
    r.highest = *highest;
    r.p99 = percentile(magnitudes, 0.99);
    r.p95 = percentile(magnitudes, 0.95);
    r.p50 = percentile(magnitudes, 0.5);
}

std::vector<std::uint64_t> histogram_of(const deviation_result& r, std::size_t bins) {
    std::vector<std::uint64_t> counts(bins);
    if (bins == 0) return counts;
    const double width = r.highest - r.lowest;
    for (const double d : r.distances) {
        const double at = width > 0.0 ? (d - r.lowest) / width * static_cast<double>(bins) : 0.0;
        const auto bin = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins)));
        ++counts[std::min(bin, bins - 1)];
    }
    return counts;
}

std::array<std::uint64_t, 3> counts_in(const std::array<double, 2>& band,
                                       std::span<const double> distances) {
    std::array<std::uint64_t, 3> counts{};
    for (const double d : distances) ++counts[d < band[0] ? 0 : d > band[1] ? 2 : 1];
    return counts;
}

/// All of `meshes` as one.
mesh joined(std::span<const prepared_mesh> meshes) {
    mesh all;
    for (const prepared_mesh& one : meshes) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        const mesh_view part = one.indexed_view();
        all.points.insert(all.points.end(), part.points.begin(), part.points.end());
        for (const auto& [a, b, c] : part.faces)
            all.faces.push_back({first + a, first + b, first + c});
    }
    return all;
}

std::optional<deviation_result> deviation_from(const prepared_mesh& a, const prepared_mesh& b,
                                               bool solid, const deviation_options& options) {
    const mesh_view from = a.indexed_view(), to = b.indexed_view();
    check_deviation(options);
    detail::place::check_finite("deviation", from.points);
    if (from.points.empty() || to.faces.empty()) return std::nullopt;
    detail::base::work_progress work(options.progress);
    deviation_result r;
    const auto stopped = [&] {
        r = {};
        r.status = treeform::status::cancelled;
        return r;
    };
    const auto found = distances_to(b, from.points, work, 0.0, options.both_ways ? 0.4 : 0.7);
    if (work.cancelled()) return stopped();
    detail::place::point_sides sides;
    r.is_signed = solid && detail::intersect::is_closed(b);
    if (r.is_signed) {
        // Distances are within 16 u L of the true ones, L at most 4 times the largest coordinate.
        const double error = 0x1p-44 * std::max(largest_in(from.points), largest_in(to.points));
        sides = detail::place::sides_in_order(
            to, detail::nearness::closest_point_query_of(b).faces_tree(), found.points,
            found.distance, error);
    }
    if (!work.reach(options.both_ways ? 0.55 : 0.95)) return stopped();
    r.winding_numbers = sides.winding_numbers;
    if (r.is_signed) r.side_counts.emplace();
    for (const std::int8_t side : sides.side)
        ++(*r.side_counts)[static_cast<std::size_t>(side + 1)];
    r.distances.resize(from.points.size());
    r.faces.resize(from.points.size());
    for (std::size_t i = 0; i < found.order.size(); ++i) {
        const double side = r.is_signed ? sides.side[i] : 1.0;
        r.distances[found.order[i]] = side == 0.0 ? 0.0 : std::copysign(found.distance[i], side);
        r.faces[found.order[i]] = found.face[i];
    }
    enter_moments(r);
    r.max_bound = bound_of(from, r.distances);
    r.histogram = histogram_of(r, options.bins);
    if (options.band) r.band_counts = counts_in(*options.band, r.distances);
    if (options.both_ways && !from.faces.empty()) {
        const auto used = detail::base::used_points(to.points.size(), to.faces);
        std::vector<point3> points;
        points.reserve(used.size());
        for (const std::uint32_t i : used) points.push_back(to.points[i]);
        const auto back = distances_to(a, points, work, 0.55, 0.98);
        if (work.cancelled()) return stopped();
        std::vector<double> distances(to.points.size());
        for (std::size_t i = 0; i < used.size(); ++i)
            distances[used[back.order[i]]] = back.distance[i];
        r.reverse_max = largest_of(distances);
        r.reverse_max_bound = bound_of(to, distances);
    }
    work.reach(1.0);
    return r;
}

}  // namespace

std::optional<deviation_result> deviation(const mesh_ref& given_a, const mesh_refs& given_fixed,
                                          const deviation_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    const bool solid = std::any_of(fixed.begin(), fixed.end(),
                                   [](const prepared_mesh& one) { return !one.is_cloud(); });
    if (fixed.size() == 1) return deviation_from(a, fixed[0], solid, options);
    return deviation_from(a, prepared_mesh(joined(fixed)), solid, options);
}

}  // namespace treeform
