#include <libmesh/base/first_bad.hpp>
#include <libmesh/intersect/same_points.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace treeform::detail::intersect {
namespace {

constexpr double most = std::numeric_limits<double>::max();  // trees have finite boxes

/// Whether the ball is wide beside a coordinate of its center.
bool is_wide(const implicit_point& p) {
    const point3& c = p.center();
    return p.radius() > 0x1p-30 * std::min({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
}

/// Boxes that hold the points.
///
/// A ball is as wide as the rounding of its largest coordinate. Beside the others that may be much:
/// of points far out along one axis most would be within most. These are rounded axis by axis.
class enclosures {
  public:
    explicit enclosures(std::span<const implicit_point> points) : points_(points) {
        const std::size_t first =
            base::first_bad(points.size(), [&](std::size_t i) { return is_wide(points[i]); });
        if (first == points.size()) return;
        rounded_.resize(points.size());
        for_chunks(points.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                if (is_wide(points[i])) rounded_[i] = rounded(points[i]);
        });
    }

    [[nodiscard]] aabb<double, 3> box(std::size_t i) const {
        const implicit_point& p = points_[i];
        const bool wide = is_wide(p);
        const point3& center = wide ? rounded_[i] : p.center();
        const double radius = wide ? 0.0 : p.radius();
        point3 low, high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::nextafter(std::clamp(center[axis] - radius, -most, most), -most);
            high[axis] = std::nextafter(std::clamp(center[axis] + radius, -most, most), most);
        }
        aabb<double, 3> box;
        box.include(low);
        box.include(high);
        return box;
    }

    [[nodiscard]] bool meet(std::size_t i, std::size_t j) const {
        const aabb<double, 3> a = box(i), b = box(j);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
        return true;
    }

  private:
    std::span<const implicit_point> points_;
    std::vector<point3> rounded_{};  // of those that are wide; none if none is
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> equal_pairs(
    std::span<const implicit_point> points) {
    const enclosures about(points);
    std::vector<std::uint32_t> ids(points.size());
    std::iota(ids.begin(), ids.end(), 0U);
    const tree<3> boxes = build(ids, [&](std::uint32_t i) { return about.box(i); });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const id_pair& pair : search_self_all(boxes, [&](std::uint32_t a, std::uint32_t b) {
             return about.meet(a, b) && equal(points[a], points[b]);
         }))
        result.emplace_back(pair.first, pair.second);
    return result;
}

}  // namespace treeform::detail::intersect
