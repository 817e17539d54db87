#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/weld/joined_faces.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace treeform {

std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh) {
    const mesh_defects defects = find_defects(mesh);
    std::vector<std::uint32_t> unusable;
    std::merge(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(),
               defects.out_of_range_faces.begin(), defects.out_of_range_faces.end(),
               std::back_inserter(unusable));
    if (unusable.empty()) return {};
    std::vector<std::uint32_t> number_before;
    std::size_t kept = 0;
    auto next = unusable.begin();
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (next != unusable.end() && *next == f) {
            ++next;
            continue;
        }
        mesh.faces[kept++] = mesh.faces[f];
        number_before.push_back(f);
    }
    mesh.faces.resize(kept);
    return number_before;
}

usable_mesh as_mesh(mesh_file file) {
    detail::base::check_faces("as_mesh", file.mesh.points.size(), file.mesh.faces);
    usable_mesh result;
    const std::size_t before = file.mesh.faces.size();
    result.triangle_of_face = drop_unusable_faces(file.mesh);
    result.dropped = before - file.mesh.faces.size();
    detail::weld::joined_faces joined = detail::weld::join_faces(file.mesh);
    if (joined.changed) file.mesh.faces = std::move(joined.faces);
    for (point3& p : file.mesh.points)  // behind the join, or a 0 of ours might stand for another
        if (!detail::base::is_finite(p)) p = {};
    result.mesh = std::move(file.mesh);
    result.stored_face = std::move(file.stored_face);
    return result;
}

}  // namespace treeform
