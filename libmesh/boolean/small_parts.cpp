#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/small_parts.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// [components] The volume of each, without its sign.
std::vector<double> volumes_of_parts(mesh_view mesh, std::span<const std::uint32_t> part_of) {
    std::vector<std::size_t> end;  // of the faces of each part, by part
    for (const std::uint32_t part : part_of) {
        if (part == end.size()) end.push_back(0);
        ++end[part];
    }
    for (std::size_t part = 1; part < end.size(); ++part) end[part] += end[part - 1];
    std::vector<std::size_t> next(end.size(), 0);
    std::copy(end.begin(), end.end() - 1, next.begin() + 1);
    std::vector<face> by_part(part_of.size());
    for (std::size_t f = 0; f < part_of.size(); ++f) by_part[next[part_of[f]]++] = mesh.faces[f];
    std::vector<double> volumes(end.size());
    for (std::size_t part = 0, begin = 0; part < end.size(); begin = end[part++])
        volumes[part] =
            std::abs(signed_volume({mesh.points, {by_part.data() + begin, end[part] - begin}}));
    return volumes;
}

/// Of each list of something by point, what the points that are used have.
template <class... Lists>
void keep_at(std::span<const std::uint32_t> used, Lists&... lists) {
    const auto keep = [&](auto& list) {
        if (list.empty()) return;
        for (std::size_t p = 0; p < used.size(); ++p) list[p] = list[used[p]];
        list.resize(used.size());
    };
    (keep(lists), ...);
}

}  // namespace

void drop_small_parts(boolean_result& result, double least) {
    mesh& solid = result.mesh;
    if (solid.faces.empty()) return;
    const std::vector<std::uint32_t> part_of = face_components(solid.points.size(), solid.faces);
    const std::vector<double> volumes = volumes_of_parts(solid, part_of);
    for (const double volume : volumes) {
        if (!(volume < least)) continue;
        ++result.statistics.small_parts;
        result.statistics.small_volume += volume;
    }
    if (result.statistics.small_parts == 0) return;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < part_of.size(); ++f) {
        if (volumes[part_of[f]] < least) continue;
        solid.faces[kept] = solid.faces[f];
        result.face_source[kept++] = result.face_source[f];
    }
    solid.faces.resize(kept);
    result.face_source.resize(kept);
    const std::vector<std::uint32_t> used = base::used_points(solid.points.size(), solid.faces);
    std::vector<std::uint32_t> new_of_old(solid.points.size(), 0);
    for (std::uint32_t p = 0; p < used.size(); ++p) new_of_old[used[p]] = p;
    for (face& f : solid.faces)
        for (std::uint32_t& corner : f) corner = new_of_old[corner];
    keep_at(used, solid.points, result.vertex_source, result.face_of_cut_vertex);
}

}  // namespace treeform::detail::boolean
