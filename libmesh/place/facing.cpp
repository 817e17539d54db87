#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/double_double.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/facing.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/measure.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::place {
namespace {

/// Corners of a component that are tried until one is on no other component.
constexpr std::size_t most_corners_tried = 64;

/// [F] the component of each face, by edges, numbered in the order of their lowest faces.
std::vector<std::uint32_t> components_by_edges(mesh_view joined) {
    base::union_find linked(joined.faces.size());
    const weld::edge_uses edges(joined.points.size(), joined.faces,
                                weld::repeated_corners::left_out);
    edges.for_each([&](const weld::used_edge& edge, std::size_t) {
        for (std::size_t i = 1; i < edge.uses.size(); ++i) linked.join(edge.face(0), edge.face(i));
    });
    const auto root = linked.take_roots();
    std::vector<std::uint32_t> component(joined.faces.size());
    std::uint32_t count = 0;
    for (std::uint32_t f = 0; f < component.size(); ++f)
        component[f] = root[f] == f ? count++ : component[root[f]];
    return component;
}

/// The volume of each component, six times.
std::vector<double> volumes_of(mesh_view joined, const std::vector<std::uint32_t>& component,
                               std::size_t count) {
    std::vector<base::double_double> sums(count);
    for (std::size_t f = 0; f < joined.faces.size(); ++f) {
        const auto& [a, b, c] = joined.faces[f];
        base::double_double& sum = sums[component[f]];
        sum = sum + base::determinant(joined.points[a], joined.points[b], joined.points[c]);
    }
    std::vector<double> volumes;
    for (const base::double_double& sum : sums) volumes.push_back(sum.high);
    return volumes;
}

/// [components] how often the others wind around each one, at the first of its corners that is not
/// on them; 0 where all that were tried are.
std::vector<std::int32_t> windings_of_others(const prepared_mesh& mesh, mesh_view joined,
                                             const std::vector<std::uint32_t>& component,
                                             std::size_t count) {
    std::vector<std::int32_t> windings(count, 0);
    if (count < 2) return windings;
    const intersect::point_locator locator(joined, build_face_tree(mesh));
    std::vector<std::size_t> tried(count, 0);
    for (std::uint32_t f = 0; f < joined.faces.size(); ++f) {
        const std::uint32_t own = component[f];
        if (tried[own] >= most_corners_tried) continue;
        ++tried[own];
        const auto found =
            locator.winding_of(joined.points[joined.faces[f][tried[own] % 3]],
                               [&](std::uint32_t other) { return component[other] != own; });
        if (!found) continue;
        windings[own] = *found;
        tried[own] = most_corners_tried;
    }
    return windings;
}

}  // namespace

facing::facing(const prepared_mesh& mesh) {
    const mesh_view joined = weld::join_faces(mesh).of(mesh.indexed_view());
    component_of_face_ = components_by_edges(joined);
    std::size_t count = 0;
    for (const std::uint32_t c : component_of_face_) count = std::max<std::size_t>(count, c + 1);
    const auto volumes = volumes_of(joined, component_of_face_, count);
    const auto around = windings_of_others(mesh, joined, component_of_face_, count);
    for (std::size_t c = 0; c < count; ++c) {
        const std::int32_t front = around[c] - (volumes[c] < 0.0 ? 1 : 0);
        sides_.push_back({front != 0, front + 1 != 0});
        inside_out_ += volumes[c] < 0.0 && around[c] == 0;
    }
}

const facing& facing_of(const prepared_mesh& mesh) {
    constexpr base::slot<facing> slot{base::slot_name::facing};
    return base::prepared_slots::get(mesh, slot, [&] { return facing(mesh); });
}

inside_sides sides_beside(const shape& of, std::uint32_t face) {
    inside_sides sides = facing_of(of.prepared()).of(face);
    if (of.mirrored()) std::swap(sides.front, sides.behind);
    return sides;
}

bool looks_inward(const shape& of, std::uint32_t face) {
    if (!of.closed()) return false;
    const inside_sides sides = sides_beside(of, face);
    return sides.front && !sides.behind;
}

}  // namespace treeform::detail::place

namespace treeform {

std::uint64_t count_inside_out(const mesh_ref& given_mesh) {
    const detail::base::prepared_ref mesh(given_mesh);
    detail::place::check_operand("count_inside_out", "mesh", mesh);
    if (mesh.view().faces.empty() || !detail::intersect::is_closed(mesh)) return 0;
    return detail::place::facing_of(mesh).inside_out();
}

}  // namespace treeform
