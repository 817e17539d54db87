#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::minus;

constexpr std::uint32_t no_coordinate = corner_values::none;

/// Twice the area of a face, along its normal.
point3 area_vector_of(mesh_view mesh, std::size_t f) {
    const auto [p, q, r] = detail::base::triangle_of(mesh, static_cast<std::uint32_t>(f));
    return cross(minus(q, p), minus(r, p));
}

/// How many units of texture there are to one of length, on average over the faces that have any.
double texture_scale(const attribute_source& of) {
    const mesh_view mesh = of.file->mesh;
    const corner_values& corners = of.file->attributes.corners;
    if (corners.texture_of_corner.empty()) return 0.0;
    double lengths = 0.0, texels = 0.0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const face& t = corners.texture_of_corner[of.triangle(f)];
        if (std::ranges::count(t, no_coordinate) > 0) continue;
        const auto &a = corners.texture[t[0]], &b = corners.texture[t[1]],
                   &c = corners.texture[t[2]];
        const double area = std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        const point3 across = area_vector_of(mesh, f);
        const double size = std::sqrt(dot(across, across));
        if (!std::isfinite(area) || !std::isfinite(size)) continue;
        texels += area;
        lengths += size;
    }
    return lengths > 0.0 && texels > 0.0 ? std::sqrt(texels / lengths) : 0.0;
}

/// Axes of the plane across `normal`, or the other way: the same for both sides of a cut.
std::array<point3, 3> axes_across(point3 normal) {
    constexpr double noise = 0x1p-40;
    const std::array<double, 3> size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const double largest = *std::ranges::max_element(size);
    for (std::size_t k = 0; k < 3; ++k) {
        normal[k] = size[k] <= noise * largest ? 0.0 : normal[k] / largest;
        if (size[k] == largest && normal[k] < 0.0) normal = {-normal.x, -normal.y, -normal.z};
    }
    return oriented_plane{{}, normal}.axes();
}

}  // namespace

void attribute_source::texture_caps(mesh_file& piece, std::span<const std::uint32_t> cap) const {
    if (cap.empty()) return;
    const double scale = texture_scale(*this);
    if (scale == 0.0) return;
    std::map<std::uint32_t, point3> normals;
    for (std::size_t f = 0; f < cap.size(); ++f) {
        if (cap[f] == operand_element::none) continue;
        point3& normal = normals[cap[f]];
        const point3 area = area_vector_of(piece.mesh, f);
        // The other side of the cut may be there, too.
        normal = dot(normal, area) < 0.0 ? minus(normal, area) : detail::base::plus(normal, area);
    }
    std::map<std::uint32_t, std::array<point3, 3>> axes_of;
    for (const auto& [plane, normal] : normals)
        if (dot(normal, normal) > 0.0) axes_of.emplace(plane, axes_across(normal));
    if (axes_of.empty()) return;
    corner_values& corners = piece.attributes.corners;
    if (corners.texture_of_corner.empty())
        corners.texture_of_corner.assign(piece.mesh.faces.size(),
                                         {no_coordinate, no_coordinate, no_coordinate});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number_of;  // by cap, point
    for (std::size_t f = 0; f < cap.size(); ++f) {
        const auto found = axes_of.find(cap[f]);
        if (found == axes_of.end()) continue;
        const auto& [x, y, normal] = found->second;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = piece.mesh.faces[f][k];
            const auto next = static_cast<std::uint32_t>(corners.texture.size());
            const auto [at, fresh] = number_of.try_emplace({cap[f], v}, next);
            const point3& p = piece.mesh.points[v];
            if (fresh) corners.texture.push_back({scale * dot(x, p), scale * dot(y, p), 0.0});
            corners.texture_of_corner[f][k] = at->second;
        }
    }
}

}  // namespace treeform
