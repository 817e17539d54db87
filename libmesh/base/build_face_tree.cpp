#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/checked_face_tree.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <treeform/tree/build.hpp>

#include <cmath>

namespace treeform {

tree<3> build_face_tree(mesh_view mesh) {
    detail::base::check_faces("build_face_tree", mesh.points.size(), mesh.faces);
    return detail::base::checked_face_tree(mesh);
}

const tree<3>& build_face_tree(const prepared_mesh& mesh) {
    constexpr detail::base::slot<tree<3>> slot{detail::base::slot_name::build_face_tree};
    return detail::base::prepared_slots::get(mesh, slot,
                                             [&] { return build_face_tree(mesh.view()); });
}

tree<3> detail::base::checked_face_tree(mesh_view mesh) {
    return build(mesh.faces, [points = mesh.points](const face& f) {
        aabb<double, 3> box;
        double sum = 0.0;  // of zeros; NaN where a coordinate is NaN or infinite
        for (const std::uint32_t corner : f) {
            const point3& p = points[corner];
            box.include(p);
            sum += 0.0 * p.x + 0.0 * p.y + 0.0 * p.z;
        }
        return sum == 0.0 ? box : aabb<double, 3>{};  // the build names an empty box
    });
}

}  // namespace treeform
