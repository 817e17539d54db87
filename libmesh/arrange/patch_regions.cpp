#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/radial_order.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform::detail::arrange {

void patch_regions::join_about_edges(mesh_view mesh, const mesh_arrangement& cut) {
    join_about_edges(mesh, cut, {});
}

void patch_regions::join_about_edges(mesh_view mesh, const mesh_arrangement& cut,
                                     std::span<const std::uint8_t> conduct) {
    const auto conducts = [&](face_side s) { return conduct.empty() || conduct[face_of(s)] != 0; };
    std::vector<std::optional<std::array<std::uint32_t, 2>>> broken(patches_.junctions.size());
    for_chunks(patches_.junctions.size(), 1, [&](std::size_t, std::size_t, std::size_t c) {
        const junction_list& list = patches_.junctions[c];
        radial_order radial(mesh, cut);
        std::vector<face_side> order;
        for (std::size_t e = 0; e < list.edges.size() && !broken[c]; ++e) {
            const auto sides = list.sides_of(e);
            order.assign(sides.begin(), sides.end());
            if (!radial.sort(list.edges[e].points, order)) broken[c] = list.edges[e].points;
            for (std::size_t i = 0; i < order.size(); ++i) {
                const face_side next = order[(i + 1) % order.size()];
                if (conducts(order[i]) && conducts(next)) join(order[i], other_side(next));
            }
        }
    });
    for (const auto& edge : broken)
        if (edge)
            throw std::logic_error(
                "treeform::find_cells: faces lie on each other at the edge between points " +
                std::to_string((*edge)[0]) + " and " + std::to_string((*edge)[1]));
}

}  // namespace treeform::detail::arrange
