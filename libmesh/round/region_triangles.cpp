#include <libmesh/arrange/planar_box.hpp>
#include <libmesh/arrange/planar_triangulation.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/round/region_triangles.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::round {
namespace {

constexpr std::uint32_t frame_size = 3;  ///< vertices that hold the region, and are not of it

class triangulator {
  public:
    triangulator(const exact_surface& surface, const flat_region& region)
        : surface_(surface), region_(region), ids_(region.points) {
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    }

    std::vector<face> run() {
        project();
        arrange::planar_triangulation plane = start();
        for (std::uint32_t i = 0; i < ids_.size(); ++i)
            if (plane.insert(frame_size + i) != frame_size + i) fail();
        force_rim(plane);
        return inside(plane);
    }

  private:
    using edge = std::array<std::uint32_t, 2>;

    [[noreturn]] static void fail() {
        throw rim_fault("treeform: a flat part of the surface has no rim");
    }

    [[nodiscard]] implicit_point point(std::uint32_t p) const {
        return p < surface_.given.size() ? implicit_point(surface_.given[p])
                                         : surface_.constructed[p - surface_.given.size()];
    }

    [[nodiscard]] std::uint32_t vertex_of(std::uint32_t p) const {
        const auto at = std::lower_bound(ids_.begin(), ids_.end(), p);
        if (at == ids_.end() || *at != p) fail();
        return frame_size + static_cast<std::uint32_t>(at - ids_.begin());
    }

    /// An axis along which the plane's projection has an area, the largest as far as doubles tell.
    void project() {
        if (region_.axis >= 0) {
            axis_ = region_.axis;
            orientation_ = region_.orientation;
            return;
        }
        const std::array<implicit_point, 3> corners{
            point(region_.plane[0]), point(region_.plane[1]), point(region_.plane[2])};
        const point3 &a = corners[0].center(), &b = corners[1].center(), &c = corners[2].center();
        const point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
        const std::array<double, 3> normal{std::abs(u.y * v.z - u.z * v.y),
                                           std::abs(u.z * v.x - u.x * v.z),
                                           std::abs(u.x * v.y - u.y * v.x)};
        std::array<int, 3> axes{0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) {
            return normal[static_cast<std::size_t>(i)] > normal[static_cast<std::size_t>(j)];
        });
        for (const int axis : axes) {
            axis_ = axis;
            orientation_ = orient2d(axis, corners[0], corners[1], corners[2]);
            if (orientation_ != 0) return;
        }
        fail();
    }

    arrange::planar_triangulation start() {
        std::pmr::vector<implicit_point> points;
        points.reserve(frame_size + ids_.size());
        points.resize(frame_size);
        for (const std::uint32_t id : ids_) points.push_back(point(id));
        const std::array<point3, 3> around = frame(points);
        std::copy(around.begin(), around.end(), points.begin());
        std::pmr::vector<std::pmr::vector<std::uint32_t>> lines(points.size());
        name_lines();
        for (std::size_t s = 0; s < region_.rim.size(); ++s)
            for (const std::uint32_t end : {region_.rim[s].from, region_.rim[s].to})
                lines[vertex_of(end)].push_back(line_of_side_[s]);
        for (auto& of_point : lines) {
            std::sort(of_point.begin(), of_point.end());
            of_point.erase(std::unique(of_point.begin(), of_point.end()), of_point.end());
        }
        return {std::move(points), std::move(lines), axis_, orientation_,
                [this](std::uint32_t line, std::uint32_t other) -> implicit_point {
                    throw sides_cross(side_on(line), side_on(other));
                }};
    }

    /// Lines with a name are those of the sides that have it, each other side has one of its own.
    void name_lines() {
        std::vector<std::uint32_t> names;
        for (const flat_region::side& side : region_.rim) names.push_back(side.line);
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        auto own = static_cast<std::uint32_t>(names.size());
        for (const flat_region::side& side : region_.rim)
            line_of_side_.push_back(
                side.line == flat_region::no_line
                    ? own++
                    : static_cast<std::uint32_t>(
                          std::lower_bound(names.begin(), names.end(), side.line) - names.begin()));
    }

    [[nodiscard]] std::size_t side_on(std::uint32_t line) const {
        return static_cast<std::size_t>(std::ranges::find(line_of_side_, line) -
                                        line_of_side_.begin());
    }

    /// A triangle that strictly holds all points in projection, wherever in their balls they are.
    [[nodiscard]] std::array<point3, 3> frame(std::span<const implicit_point> points) const {
        arrange::planar_box box(axis_);
        for (std::size_t i = frame_size; i < points.size(); ++i)
            box.include(points[i].center(), 2 * points[i].radius());
        return box.triangle_around(orientation_);
    }

    void force_rim(arrange::planar_triangulation& plane) {
        for (std::size_t s = 0; s < region_.rim.size(); ++s) {
            const auto way = plane.constrain(vertex_of(region_.rim[s].from),
                                             vertex_of(region_.rim[s].to), line_of_side_[s]);
            for (std::size_t i = 0; i + 1 < way.size(); ++i) rim_.push_back({way[i], way[i + 1]});
        }
        std::sort(rim_.begin(), rim_.end());
    }

    /// How often the region is more on the left of the way between two vertices than on its right.
    [[nodiscard]] std::ptrdiff_t step_over(std::uint32_t a, std::uint32_t b) const {
        const auto count = [&](const edge& e) {
            const auto [first, last] = std::equal_range(rim_.begin(), rim_.end(), e);
            return last - first;
        };
        return count({a, b}) - count({b, a});
    }

    /// What the rim winds around, from where it winds around nothing.
    [[nodiscard]] std::vector<face> inside(const arrange::planar_triangulation& plane) const {
        constexpr std::ptrdiff_t unknown = std::numeric_limits<std::ptrdiff_t>::max();
        std::vector<std::ptrdiff_t> winding(plane.triangle_count(), unknown);
        std::vector<std::uint32_t> open{0};
        const auto is_at_frame = [&](std::uint32_t t) {
            return std::ranges::min(plane.corners(t)) < frame_size;
        };
        while (!is_at_frame(open[0])) ++open[0];
        winding[open[0]] = 0;
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            const auto corners = plane.corners(t);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t beyond = plane.across(t, i);
                if (beyond == arrange::planar_triangulation::none || winding[beyond] != unknown)
                    continue;
                winding[beyond] = winding[t] - step_over(corners[i], corners[(i + 1) % 3]);
                open.push_back(beyond);
            }
        }
        std::vector<face> result;
        for (std::uint32_t t = 0; t < winding.size(); ++t) {
            if (winding[t] == 0) continue;
            face made{};
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t vertex = plane.corners(t)[i];
                if (vertex < frame_size) fail();
                made[i] = ids_[vertex - frame_size];
            }
            if (winding[t] < 0) std::swap(made[1], made[2]);
            result.insert(result.end(), static_cast<std::size_t>(std::abs(winding[t])), made);
        }
        return result;
    }

    const exact_surface& surface_;
    const flat_region& region_;
    std::vector<std::uint32_t> ids_;  ///< of the points, ascending
    std::vector<std::uint32_t> line_of_side_{};
    std::vector<edge> rim_{};  ///< vertices, from and to, ascending
    int axis_ = 2;
    int orientation_ = 1;
};

}  // namespace

std::vector<face> triangles_of(const exact_surface& surface, const flat_region& region) {
    return triangulator(surface, region).run();
}

}  // namespace treeform::detail::round
