#include <libmesh/base/union_find.hpp>
#include <libmesh/carry/corners.hpp>
#include <libmesh/carry/face_kinds.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/carry.hpp>

#include <algorithm>

namespace treeform {

std::vector<std::uint32_t> carry_sources::corner_groups() const {
    const carry_source& input = all_.front();
    const mesh& mesh = input.file->mesh;
    const corner_values& values = input.file->attributes.corners;
    const auto groups = detail::carry::groups_of_faces(all_, {.corners = false});
    if (groups.empty() && values.texture_of_corner.empty() && values.normal_of_corner.empty())
        return {};
    const std::vector<std::uint32_t> first = detail::weld::equal_firsts(mesh.points, {});
    std::vector<face> faces = mesh.faces;
    for (face& f : faces)
        for (std::uint32_t& c : f) c = first[c];
    const auto corner_at = [&](std::uint32_t f, std::uint32_t p) {
        return static_cast<std::size_t>(std::ranges::find(faces[f], p) - faces[f].begin());
    };
    detail::base::union_find sets(3 * faces.size());
    const detail::weld::edge_uses edges(first.size(), faces,
                                        detail::weld::repeated_corners::left_out);
    edges.for_each([&](const detail::weld::used_edge& edge, std::size_t) {
        if (edge.uses.size() != 2) return;
        const std::uint32_t f = edge.face(0), g = edge.face(1);
        if (!groups.empty() && groups[f] != groups[g]) return;
        const std::array<std::array<std::size_t, 2>, 2> ends{
            {{corner_at(f, edge.low), corner_at(g, edge.low)},
             {corner_at(f, edge.high), corner_at(g, edge.high)}}};
        if (!detail::carry::look_alike(values, {input.triangle(f), input.triangle(g)}, ends))
            return;
        for (const auto& [i, j] : ends)
            sets.join(static_cast<std::uint32_t>(3 * f + i), static_cast<std::uint32_t>(3 * g + j));
    });
    const auto roots = sets.take_roots();
    return {roots.data(), roots.data() + roots.size()};
}

}  // namespace treeform
