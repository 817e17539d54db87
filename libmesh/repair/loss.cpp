#include <libmesh/repair/loss.hpp>
#include <libmesh/topology/area.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Without faces that have the corners of another one.
double area_of_distinct(mesh_view mesh) {
    treeform::mesh joined{{mesh.points.begin(), mesh.points.end()},
                          {mesh.faces.begin(), mesh.faces.end()}};
    joined = join_equal_points(std::move(joined));
    for (face& f : joined.faces) std::ranges::sort(f);
    std::ranges::sort(joined.faces);
    const auto copies = std::ranges::unique(joined.faces);
    joined.faces.erase(copies.begin(), copies.end());
    return topology::area(joined);
}

}  // namespace

loss find_loss(mesh_view given, mesh_view made) {
    const repair_result meant = treeform::repair(given, {.fill = false, .detach = false});
    if (meant.certificate)
        return {meant.statistics.volume_after, std::abs(signed_volume(made)), true};
    return {area_of_distinct(given), topology::area(made), false};
}

bool has_inward_component(mesh_view mesh) {
    const std::vector<std::uint32_t> component = face_components(mesh.points.size(), mesh.faces);
    std::uint32_t count = 0;
    for (const std::uint32_t c : component) count = std::max(count, c + 1);
    if (count < 2) return signed_volume(mesh) < 0.0;
    std::vector<std::vector<face>> faces(count);
    for (std::size_t f = 0; f < component.size(); ++f) faces[component[f]].push_back(mesh.faces[f]);
    return std::ranges::any_of(faces, [&](const auto& part) {
        return signed_volume({mesh.points, part}) < 0.0;
    });
}

}  // namespace treeform::detail::repair
