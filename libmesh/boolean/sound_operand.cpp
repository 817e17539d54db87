#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/sound_operand.hpp>
#include <treeform/mesh/boolean.hpp>

namespace treeform::detail::boolean {
namespace {

/// Nothing was cut, joined or left out: the solid is bounded by just these faces.
bool find_out(mesh_view mesh, const progress_callback& progress) {
    const boolean_result alone =
        treeform::boolean({&mesh, 1}, boolean_expression::union_of(1), {.progress = progress});
    if (alone.certificate.status == status::cancelled) throw stopped{};
    return alone.certificate && alone.statistics.pairs == 0 && alone.statistics.degenerate == 0 &&
           alone.mesh.faces.size() == mesh.faces.size() &&
           alone.mesh.points.size() == base::used_points(mesh.points.size(), mesh.faces).size() &&
           alone.statistics.split_vertices == 0;
}

}  // namespace

bool is_sound(const prepared_mesh& mesh, const progress_callback& progress) {
    constexpr base::slot<bool> slot{base::slot_name::sound_operand};
    return base::prepared_slots::get(mesh, slot, [&] { return find_out(mesh.view(), progress); });
}

}  // namespace treeform::detail::boolean
