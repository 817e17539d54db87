#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/checked_face_tree.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <treeform/tree/build.hpp>

#include <stdexcept>

namespace treeform {

tree<3> build_face_tree(mesh_view mesh, const char* function) {
    detail::base::check_faces(function, mesh.points.size(), mesh.faces);
    try {
        return detail::base::checked_face_tree(mesh);
    } catch (const std::invalid_argument&) {  // a box, and so a face, that is not finite
        detail::base::check_finite_faces(function, mesh);
        throw;
    }
}

const tree<3>& build_face_tree(const prepared_mesh& mesh, const char* function) {
    constexpr detail::base::slot<tree<3>> slot{detail::base::slot_name::face_tree};
    return detail::base::prepared_slots::get(
        mesh, slot, [&] { return build_face_tree(mesh.indexed_view(), function); });
}

tree<3> detail::base::checked_face_tree(mesh_view mesh) {
    return build(mesh.faces, face_boxes(mesh.points));
}

}  // namespace treeform
