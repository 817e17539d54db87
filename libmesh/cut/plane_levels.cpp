#include <libmesh/base/point_math.hpp>
#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>

namespace treeform {
namespace {

using detail::base::dot;
using detail::base::is_finite;

/// Of length 1; scaled first, so that no square overflows or vanishes.
point3 unit(const point3& v) {
    const double size = detail::base::largest_of(v);
    const point3 s{v.x / size, v.y / size, v.z / size};
    const double length = std::sqrt(dot(s, s));
    return {s.x / length, s.y / length, s.z / length};
}

/// A number along the normal, and what it may be off.
struct reckoned {
    double value;
    double error;
};

/// normal . p: three products and two sums, each off by at most u = 2^-53 of what it makes and,
/// where that is a denormal or flushed, 2^-1022; 5 u of the sum of magnitudes, itself off by as
/// much, is less than 2^-50 of it.
reckoned along(const point3& normal, const point3& p) {
    const double magnitude =
        std::abs(normal.x * p.x) + std::abs(normal.y * p.y) + std::abs(normal.z * p.z);
    return {dot(normal, p), 0x1p-50 * magnitude + 0x1p-1018};
}

/// The axis that the normal runs along, or -1.
int axis_of(const point3& normal) {
    const int zeros = (normal.x == 0.0) + (normal.y == 0.0) + (normal.z == 0.0);
    if (zeros != 2) return -1;
    return normal.x != 0.0 ? 0 : normal.y != 0.0 ? 1 : 2;
}

class level_finder {
  public:
    explicit level_finder(detail::cut::plane_levels& levels)
        : levels_(levels), axis_(axis_of(levels.normal)) {
        for (const point3& at : levels.planes) {
            const reckoned h = height(at);
            // Running maxima are off by no more than the numbers, whose exact order is known.
            heights_.push_back(heights_.empty() ? h.value : std::max(h.value, heights_.back()));
            error_ = std::max(error_, h.error);
        }
    }

    void find(std::size_t point, const point3& p) const {
        if (!is_finite(p)) return;
        const reckoned h = height(p);
        const double off = h.error + error_;
        const auto begin = heights_.begin();
        std::size_t low = 0, high = heights_.size();
        if (std::isfinite(h.value) && std::isfinite(off)) {
            low = static_cast<std::size_t>(std::lower_bound(begin, heights_.end(), h.value - off) -
                                           begin);
            high = static_cast<std::size_t>(std::upper_bound(begin, heights_.end(), h.value + off) -
                                            begin);
        }
        bool on = false;
        while (low < high) {  // plane `low` - 1 is below or at the point, plane `high` is above
            const std::size_t middle = low + (high - low) / 2;
            const int side = compare_along({}, levels_.normal, levels_.planes[middle], p);
            if (side >= 0)
                low = middle + 1;
            else
                high = middle;
            on |= side == 0;
        }
        levels_.level[point] = static_cast<std::uint32_t>(low);
        levels_.on[point] = on ? 1 : 0;
    }

  private:
    /// Exact along an axis, up to a scale.
    [[nodiscard]] reckoned height(const point3& p) const {
        if (axis_ < 0) return along(levels_.normal, p);
        const auto i = static_cast<std::size_t>(axis_);
        return {levels_.normal[i] < 0.0 ? -p[i] : p[i], 0.0};
    }

    detail::cut::plane_levels& levels_;
    int axis_;
    std::vector<double> heights_;
    double error_ = 0.0;
};

}  // namespace

std::array<point3, 3> oriented_plane::axes() const {
    const point3& n = normal;
    if (!is_finite(n) || n == point3{})
        throw std::invalid_argument("treeform: the normal of a plane is zero or not finite");
    std::array<point3, 3> axes{};
    auto& [x, y, up] = axes;
    up = unit(n);
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[largest])) largest = i;
    x[(largest + 1) % 3] = 1.0;
    x = unit(detail::base::minus(x, detail::base::scaled(up, dot(x, up))));
    y = detail::base::cross(up, x);
    for (point3& axis : axes)
        for (std::size_t i = 0; i < 3; ++i) axis[i] += 0.0;  // no -0
    return axes;
}

oriented_plane oriented_plane::parallel(double height) const {
    const point3 n = axes()[2];
    oriented_plane result = *this;
    for (std::size_t i = 0; i < 3; ++i)
        if (n[i] != 0.0) result.at[i] += height * n[i];
    return result;
}

namespace detail::cut {

plane_levels levels_of(const char* function, points_view points, const oriented_plane& plane,
                       std::span<const double> heights) {
    const std::string name = std::string("treeform::") + function;
    plane_levels result;
    result.normal = plane.normal;
    std::vector<point3> at;
    for (const double height : heights) {
        at.push_back(plane.parallel(height).at);
        if (!is_finite(at.back()))
            throw std::invalid_argument(name + ": the plane at height " + std::to_string(height) +
                                        " is not finite");
    }
    if (heights.empty()) (void)plane.axes();  // refuses what is no plane
    const auto order_of = [&](std::uint32_t a, std::uint32_t b) {
        return compare_along({}, plane.normal, at[a], at[b]);
    };
    std::vector<std::uint32_t> order(at.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order,
                             [&](std::uint32_t a, std::uint32_t b) { return order_of(a, b) > 0; });
    result.rank.resize(at.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || order_of(order[i - 1], order[i]) != 0) result.planes.push_back(at[order[i]]);
        result.rank[order[i]] = static_cast<std::uint32_t>(result.planes.size() - 1);
    }
    result.level.resize(points.size());
    result.on.resize(points.size());
    const level_finder finder(result);
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) finder.find(p, points[p]);
    });
    return result;
}

met_faces faces_met(mesh_view mesh, const plane_levels& levels, std::size_t planes) {
    met_faces met;
    met.begin.assign(planes + 2, 0);
    const auto each = [&](const auto& visit) {
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
            const auto [a, b, c] = mesh.faces[f];
            const auto [low, high] =
                std::minmax({levels.level[a], levels.level[b], levels.level[c]});
            if (low == high || a == b || b == c || c == a) continue;
            for (std::uint32_t k = low; k < high; ++k) visit(f, k);
        }
    };
    each([&](std::uint32_t, std::uint32_t k) { ++met.begin[k + 2]; });
    for (std::size_t k = 2; k < met.begin.size(); ++k) met.begin[k] += met.begin[k - 1];
    met.faces.resize(met.begin.back());
    each([&](std::uint32_t f, std::uint32_t k) { met.faces[met.begin[k + 1]++] = f; });
    return met;
}

}  // namespace detail::cut
}  // namespace treeform
