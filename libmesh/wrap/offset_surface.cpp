#include <libmesh/base/point_math.hpp>
#include <libmesh/wrap/offset_surface.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::wrap {
namespace {

using base::dot;
using base::minus;
using base::plus;
using base::scaled;

/// A point so near to the offset, in shares of it, is moved onto it.
constexpr double tolerance = 0x1p-6;
/// Shares of the offset that a segment is followed by at least. Less far it may dip below unseen.
constexpr double least_step = 0x1p-3;

constexpr std::array<std::array<std::size_t, 3>, 4> faces{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// \pre orient3d of `four` > 0
bool meet(const triangle3& face, const std::array<point3, 4>& four) {
    std::array<bool, 3> inside{true, true, true};
    for (const auto& [a, b, c] : faces) {
        bool all_out = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const int side = orient3d(four[a], four[b], four[c], face[k]);
            inside[k] = inside[k] && side >= 0;
            all_out = all_out && side < 0;
        }
        if (all_out) return false;
    }
    if (inside[0] || inside[1] || inside[2]) return true;
    return std::any_of(faces.begin(), faces.end(), [&](const auto& f) {
        return intersect(face, {four[f[0]], four[f[1]], four[f[2]]}).count != 0;
    });
}

}  // namespace

offset_surface::offset_surface(mesh_view around, double offset)
    : mesh_(around), offset_(offset), nearest_(around, "wrap") {}

point3 offset_surface::at_offset(const point3& p, const point3& nearest) const {
    const point3 arm = minus(p, nearest);
    return plus(nearest, scaled(arm, offset_ / std::sqrt(dot(arm, arm))));
}

std::optional<point3> offset_surface::first_on(const point3& from, const point3& to) const {
    const point3 way = minus(to, from);
    const double length = std::sqrt(dot(way, way));
    if (!(length > 0.0)) return std::nullopt;
    // Distances change no faster than the point moves, so each step may be as long as the distance
    // from the surface.
    double at = 0.0;
    double before = 0.0;  ///< the last place on the side where `from` is
    bool first_is_out = false;
    for (bool is_first = true;; is_first = false) {
        const point3 p = plus(from, scaled(way, at / length));
        const auto near = nearest_.nearest(p);
        const double gap = near->distance - offset_;
        if (std::abs(gap) <= tolerance * offset_) return at_offset(p, near->point);
        if (is_first) first_is_out = gap > 0.0;
        if ((gap > 0.0) != first_is_out) {  // it has been passed
            const double half = 0.5 * (before + at);
            if (!(before < half && half < at)) return at_offset(p, near->point);
            at = half;
            continue;
        }
        before = at;
        if (at >= length) return std::nullopt;
        at = std::min(at + std::max(std::abs(gap), least_step * offset_), length);
    }
}

std::optional<point3> offset_surface::next_to(const point3& p) const {
    constexpr int most_steps = 16;  // more than one where the mesh is on several sides
    point3 moved = p;
    for (int step = 0; step < most_steps; ++step) {
        const auto near = nearest_.nearest(moved);
        if (step > 0 && std::abs(near->distance - offset_) <= tolerance * offset_) return moved;
        moved = at_offset(moved, near->point);
        if (!base::is_finite(moved)) return std::nullopt;
    }
    return std::nullopt;
}

bool offset_surface::meets(const std::array<point3, 4>& tetrahedron) const {
    aabb<double, 3> box;
    for (const point3& p : tetrahedron) box.include(p);
    return search_any(nearest_.faces_tree(), box, [&](std::uint32_t f) {
        return meet(base::triangle_of(mesh_, f), tetrahedron);
    });
}

}  // namespace treeform::detail::wrap
