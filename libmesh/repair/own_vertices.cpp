#include <libmesh/repair/border_edges.hpp>
#include <libmesh/repair/own_vertices.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace treeform::detail::repair {
namespace {

constexpr std::uint32_t open_part = std::numeric_limits<std::uint32_t>::max();

/// [F] The component of each face, or `open_part`.
std::vector<std::uint32_t> closed_component_of_face(mesh_view mesh) {
    std::vector<std::uint32_t> component = face_components(mesh.points.size(), mesh.faces);
    std::vector<std::uint8_t> is_open(mesh.faces.size(), 0);  // by component
    for (const border_edge& e : border_edges(mesh.points.size(), mesh.faces))
        is_open[component[e.face]] = 1;
    for (std::uint32_t& c : component)
        if (is_open[c] != 0) c = open_part;
    return component;
}

}  // namespace

void give_own_vertices(mesh_view given, mesh& made, std::span<const std::uint32_t> face_source,
                       std::vector<std::uint32_t>& vertex_source) {
    const std::vector<std::uint32_t> component = closed_component_of_face(given);
    struct corner {
        std::uint32_t vertex, component, face, slot;
    };
    std::vector<corner> corners;
    for (std::uint32_t f = 0; f < made.faces.size(); ++f) {
        const std::uint32_t from = face_source[f];
        const std::uint32_t part = from == repair_result::none ? open_part : component[from];
        for (std::uint32_t i = 0; i < 3; ++i) corners.push_back({made.faces[f][i], part, f, i});
    }
    std::ranges::stable_sort(corners, [](const corner& a, const corner& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.component < b.component;
    });
    for (std::size_t i = 1; i < corners.size(); ++i) {
        corner& at = corners[i];
        const corner& before = corners[i - 1];
        if (at.vertex != before.vertex || at.component == open_part) continue;
        std::uint32_t own = made.faces[before.face][before.slot];
        if (at.component != before.component) {
            own = static_cast<std::uint32_t>(made.points.size());
            const point3 same = made.points[at.vertex];
            made.points.push_back(same);
            vertex_source.push_back(vertex_source[at.vertex]);
        }
        made.faces[at.face][at.slot] = own;
    }
}

}  // namespace treeform::detail::repair
