#include <libmesh/place/align_surface.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace treeform::detail::place {
namespace {

constexpr std::size_t points_of_plane = 12;
constexpr std::size_t most_of_plane = 16 * points_of_plane;
constexpr double like_line = 0.05;  ///< of the squares across, to those along

void leave_out_equal(std::vector<point3>& points) {
    const auto key = [](const point3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(),
              [&](const point3& a, const point3& b) { return key(a) < key(b); });
    const auto equal = [&](const point3& a, const point3& b) { return key(a) == key(b); };
    points.erase(std::unique(points.begin(), points.end(), equal), points.end());
}

/// False where the points are on a line.
bool fit_plane(const std::vector<point3>& points, std::span<const near_point> of, surfel& to) {
    to.reach = of.empty() ? 0.0 : of.back().distance;
    if (of.size() < 3) return false;
    Vector3d center = Vector3d::Zero();
    for (const near_point& n : of) center += vector_of(points[n.id]);
    center /= static_cast<double>(of.size());
    Matrix3d sums = Matrix3d::Zero();
    for (const near_point& n : of) {
        const Vector3d arm = vector_of(points[n.id]) - center;
        sums += arm * arm.transpose();
    }
    const eigen_system<3> system = eigen_in_closed_form(sums);
    if (!(system.values(1) > like_line * system.values(2))) return false;
    to.normal = system.vectors.col(0);
    // three points are in the plane whatever it is
    const double free = std::max(static_cast<double>(of.size()) - 3.0, 1.0);
    to.thickness = std::sqrt(std::max(system.values(0), 0.0) / free);
    return true;
}

}  // namespace

searched_cloud::searched_cloud(std::vector<point3> points) : points_(std::move(points)) {
    leave_out_equal(points_);
    search_ = point_search<3>(points_, array_of);
}

std::vector<surfel> searched_cloud::surfels_at(std::span<const point3> places) const {
    std::vector<surfel> found(places.size());
    std::vector<std::uint32_t> open(places.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<std::uint32_t>(i);
    std::vector<std::uint8_t> fits(places.size());
    for (std::size_t k = points_of_plane; k <= most_of_plane && !open.empty(); k *= 4) {
        std::vector<std::array<double, 3>> queries;
        queries.reserve(open.size());
        for (const std::uint32_t i : open) queries.push_back(array_of(places[i]));
        const auto near = search_.k_nearest(queries, k);
        for_chunks(open.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                fits[open[i]] = fit_plane(points_, near[i], found[open[i]]) ? 1 : 0;
        });
        std::erase_if(open, [&](std::uint32_t i) { return fits[i] != 0; });
    }
    return found;
}

}  // namespace treeform::detail::place
