#include <libmesh/repair/remove_faces.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/topology.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform {
namespace {

repaired_mesh from(solid_result&& made) {
    repaired_mesh result;
    result.surface = std::move(made.surface);
    for (const operand_element& e : made.source_face) result.face_of.push_back(e.index);
    for (const operand_element& e : made.source_point) result.point_of.push_back(e.index);
    result.max_move = made.max_move;
    result.certified = made.certified;
    result.meeting = std::move(made.meeting_faces);
    result.meeting_count = made.meeting_count;
    result.open = std::move(made.open);
    result.open_count = made.open_count;
    result.covered = made.covered;
    result.exact_faces = made.exact_faces;
    result.cancelled = made.cancelled;
    return result;
}

void count_losses(mesh_view mesh, repaired_mesh& result) {
    const std::vector<std::uint32_t> component = face_components(mesh.points.size(), mesh.faces);
    std::uint32_t components = 0;
    for (const std::uint32_t c : component) components = std::max(components, c + 1);
    std::vector<char> is_left(mesh.faces.size()), has_face(components);
    for (const std::uint32_t f : result.face_of) {
        if (f == repaired_mesh::none) {
            ++result.filled;
            continue;
        }
        is_left[f] = 1;
        has_face[component[f]] = 1;
    }
    const auto gone = static_cast<std::uint64_t>(std::ranges::count(is_left, 0));
    result.removed = gone - std::min(gone, result.covered);
    result.lost_components = static_cast<std::uint64_t>(std::ranges::count(has_face, 0));
}

}  // namespace

repaired_mesh repair(mesh_view mesh, const repair_options& options) {
    const boolean_options as_boolean{.inside = options.inside,
                                     .to_float = options.to_float,
                                     .rounding_steps = options.rounding_steps,
                                     .progress = options.progress};
    repaired_mesh result;
    switch (options.mode) {
        case repair_mode::split:
            result = from(split({&mesh, 1}, as_boolean));
            break;
        case repair_mode::outer:
            result = from(boolean({&mesh, 1}, boolean_expression::union_of(1), as_boolean));
            break;
        case repair_mode::remove:
            result = detail::repair::remove_faces(mesh, options);
            break;
    }
    if (!result.cancelled && result.open_count == 0) count_losses(mesh, result);
    return result;
}

}  // namespace treeform
