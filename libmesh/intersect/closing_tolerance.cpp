#include <libmesh/base/stars.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/point_location.hpp>

#include <algorithm>
#include <utility>

namespace treeform {
namespace {

/// Faces that keep fewer than three corners have no edges; nothing but such is no surface.
bool closes(mesh_view mesh, double tolerance) {
    treeform::mesh copy{{mesh.points.begin(), mesh.points.end()},
                        {mesh.faces.begin(), mesh.faces.end()}};
    const usable_mesh joined = usable_faces(std::move(copy), {}, {.tolerance = tolerance});
    const auto& faces = joined.mesh.faces;
    return std::any_of(faces.begin(), faces.end(), detail::base::has_three_corners) &&
           !find_open_edge(joined.mesh);
}

}  // namespace

std::optional<std::size_t> closing_tolerance(mesh_view mesh, std::span<const double> tolerances) {
    if (closes(mesh, 0.0)) return std::nullopt;
    for (std::size_t i = 0; i < tolerances.size(); ++i)
        if (closes(mesh, tolerances[i])) return i;
    return std::nullopt;
}

}  // namespace treeform
