#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/cut/layer_loops.hpp>
#include <libmesh/cut/nested_loops.hpp>
#include <libmesh/cut/plane_levels.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

namespace cut = detail::cut;
using detail::base::dot;
using detail::base::plus;
using detail::base::scaled;

/// A layer by itself.
struct drawn_layer {
    section_layer totals;
    std::vector<section_loop> loops;
    std::vector<point2> points;
    std::vector<std::uint32_t> faces;
};

void measure(section_loop& loop, std::span<const point2> points) {
    const point2 origin = points.front();
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!loop.closed && i + 1 == points.size()) break;
        const point2& p = points[i];
        const point2& q = points[i + 1 == points.size() ? 0 : i + 1];
        loop.length += std::hypot(q.x - p.x, q.y - p.y);
        twice += (p.x - origin.x) * (q.y - origin.y) - (p.y - origin.y) * (q.x - origin.x);
    }
    if (loop.closed) loop.area = twice / 2;
}

/// Whether the faces lie in one plane and look the same way, exactly. Not where one has no area.
bool continues(mesh_view mesh, std::uint32_t a, std::uint32_t b) {
    const auto &p = mesh.faces[a], &q = mesh.faces[b];
    const auto at = [&](std::uint32_t v) -> const point3& { return mesh.points[v]; };
    for (const std::uint32_t v : q)
        if (v != p[0] && v != p[1] && v != p[2] &&
            orient3d(at(p[0]), at(p[1]), at(p[2]), at(v)) != 0)
            return false;
    for (int axis = 0; axis < 3; ++axis)
        if (const int turn = orient2d(axis, at(p[0]), at(p[1]), at(p[2])); turn != 0)
            return turn == orient2d(axis, at(q[0]), at(q[1]), at(q[2]));
    return false;
}

/// Leaves out points at which loops go straight on, from a face to another one in its plane. Those
/// of loops whose faces disagree stay.
void straighten(mesh_view mesh, cut::layer_loops& traced) {
    std::size_t to = 0;
    for (auto& [first, count, closed, oriented] : traced.loops) {
        const std::size_t begin = std::exchange(first, to), end = begin + count;
        std::vector<std::size_t> kept;
        for (std::size_t i = begin; i < end; ++i) {
            const bool ends = !closed && (i == begin || i + 1 == end);
            if (ends || !oriented ||
                !continues(mesh, traced.faces[i == begin ? end - 1 : i - 1], traced.faces[i]))
                kept.push_back(i);
        }
        const bool flat = closed && kept.size() < 3;  // there and back, through nothing
        if (!flat) count = kept.size();
        for (std::size_t i = 0; i < count; ++i, ++to) {
            const std::size_t from = flat ? begin + i : kept[i];
            traced.points[to] = traced.points[from];
            traced.faces[to] = traced.faces[from];
        }
    }
    traced.points.resize(to);
    traced.faces.resize(to);
}

drawn_layer draw(mesh_view mesh, const cut::plane_levels& levels, const std::array<point3, 3>& axes,
                 std::uint32_t k, std::span<const std::uint32_t> faces) {
    cut::layer_loops traced = cut::loops_of(mesh, levels, k, faces);
    straighten(mesh, traced);
    drawn_layer layer;
    std::vector<point3> centers;
    centers.reserve(traced.points.size());
    layer.points.reserve(traced.points.size());
    double radius = 0.0;
    for (const cut::crossing& c : traced.points) {
        const implicit_point exact = cut::exact_point(mesh, levels, k, c);
        point3 center = exact.center();
        double off = exact.radius();
        const double reach = detail::base::largest_of(center);
        if (!(off <= 0x1p-46 * reach)) {  // the edge is all but parallel to the plane
            center = rounded(exact);
            off = 0x1p-52 * reach + 0x1p-1021;
        }
        radius = std::max(radius, off);
        centers.push_back(center);
        layer.points.push_back({dot(axes[0], center), dot(axes[1], center)});
    }
    const std::vector<cut::nesting> nested =
        cut::nested_loops(mesh, levels, k, traced, centers, radius);
    for (std::size_t l = 0; l < traced.loops.size(); ++l) {
        const auto& [first, count, closed, oriented] = traced.loops[l];
        section_loop loop{first, count, closed, oriented, nested[l].parent, nested[l].depth};
        measure(loop, std::span(layer.points).subspan(first, count));
        layer.totals.area += loop.area;
        layer.totals.length += loop.length;
        layer.totals.open_count += closed ? 0 : 1;
        layer.loops.push_back(loop);
    }
    layer.faces = std::move(traced.faces);
    return layer;
}

/// Adds the loops of a layer, with numbers in the whole.
void add_layer(section_result& result, const drawn_layer& layer, double height, const point3& at) {
    section_layer totals = layer.totals;
    totals.height = height;
    totals.at = at;
    totals.first_loop = static_cast<std::uint32_t>(result.loops.size());
    totals.loop_count = static_cast<std::uint32_t>(layer.loops.size());
    if (result.loops.size() + layer.loops.size() >= section_loop::none)
        throw std::length_error("treeform::section: more loops than 32-bit numbers can name");
    for (section_loop loop : layer.loops) {
        loop.first_point += result.points.size();
        if (loop.parent != section_loop::none) loop.parent += totals.first_loop;
        result.loops.push_back(loop);
    }
    result.points.insert(result.points.end(), layer.points.begin(), layer.points.end());
    result.faces.insert(result.faces.end(), layer.faces.begin(), layer.faces.end());
    result.layers.push_back(totals);
}

section_result sections_of(mesh_view mesh, const detail::weld::joined_faces& joined,
                           const oriented_plane& plane, std::span<const double> heights,
                           const progress_callback& report) {
    section_result result;
    result.axes = plane.axes();
    detail::base::work_progress progress(report);
    const auto cancelled = [&] {
        result = {};
        result.status = status::cancelled;
        return result;
    };
    if (!progress.reach(0.0)) return cancelled();
    const mesh_view merged = joined.of(mesh);
    const cut::plane_levels levels = cut::levels_of("section", mesh.points, plane, heights);
    const cut::met_faces met = cut::faces_met(merged, levels, levels.planes.size());
    std::vector<drawn_layer> layers(levels.planes.size());
    std::atomic<std::size_t> done{0};
    for_chunks(layers.size(), 1, [&](std::size_t begin, std::size_t, std::size_t) {
        if (progress.cancelled()) return;
        const auto k = static_cast<std::uint32_t>(begin);
        layers[k] = draw(merged, levels, result.axes, k, met.of(k));
        progress.reach(0.1 +
                       0.8 * static_cast<double>(++done) / static_cast<double>(layers.size()));
    });
    if (progress.cancelled()) return cancelled();
    std::size_t points = 0;
    for (const std::uint32_t k : levels.rank) points += layers[k].points.size();
    result.points.reserve(points);
    result.faces.reserve(points);
    for (std::size_t i = 0; i < heights.size(); ++i)
        add_layer(result, layers[levels.rank[i]], heights[i], levels.planes[levels.rank[i]]);
    return progress.reach(1.0) ? std::move(result) : cancelled();
}

void check_mesh(mesh_view mesh) {
    detail::base::check_faces("section", mesh.points.size(), mesh.faces);
    detail::base::check_finite_faces("section", mesh);
}

}  // namespace

section_result section(const mesh_ref& mesh, const oriented_plane& plane,
                       std::span<const double> heights, const progress_callback& progress) {
    check_mesh(mesh.view());
    return sections_of(mesh.view(),
                       mesh.prepared() != nullptr ? detail::weld::join_faces(*mesh.prepared())
                                                  : detail::weld::join_faces(mesh.view()),
                       plane, heights, progress);
}

point3 section_result::in_space(const section_layer& layer, const point2& p) const {
    const auto& [x, y, normal] = axes;
    return plus(plus(scaled(x, p.x), scaled(y, p.y)), scaled(normal, dot(normal, layer.at)));
}

std::vector<double> oriented_plane::layer_heights(points_view points, double thickness) const {
    const point3 n = axes()[2];
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const double zero = dot(n, at);
    if (!std::isfinite(zero))
        throw std::invalid_argument(
            "treeform::oriented_plane::layer_heights: the plane is not finite");
    for (const point3& p : points) {
        const double height = dot(n, p) - zero;
        if (!std::isfinite(height)) continue;
        low = std::min(low, height);
        high = std::max(high, height);
    }
    if (!(thickness > 0.0) || (high - low) / thickness > 0x1p24)
        throw std::invalid_argument(
            "treeform::oriented_plane::layer_heights: the thickness is not positive, or would make "
            "more than 2^24 layers");
    std::vector<double> heights;
    for (std::size_t i = 0;; ++i) {
        const double height = low + (static_cast<double>(i) + 0.5) * thickness;
        if (!(height < high)) return heights;
        heights.push_back(height);
    }
}

}  // namespace treeform
