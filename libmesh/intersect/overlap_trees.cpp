#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/intersect/overlap_trees.hpp>

#include <stdexcept>
#include <vector>

namespace treeform::detail::intersect {
namespace {

void check_finite_faces_moved(const char* function, mesh_view mesh, const transform<3>& by) {
    std::vector<point3> moved(mesh.points.begin(), mesh.points.end());
    for (point3& p : moved) p = by(p);
    base::check_finite_faces(function, {moved, mesh.faces});
}

}  // namespace

std::pair<partial_tree<3>, partial_tree<3>> overlap_trees(const std::string& function, mesh_view a,
                                                          mesh_view b,
                                                          const mesh_positions& positions) {
    const std::string name_a = function + ": a", name_b = function + ": b";
    const auto& [move_a, move_b] = positions;
    if (!move_a.finite() || !move_b.finite())
        throw std::invalid_argument("treeform::" + function + ": a transform is not finite");
    base::check_faces(name_a.c_str(), a.points.size(), a.faces);
    base::check_faces(name_b.c_str(), b.points.size(), b.faces);
    try {
        if (move_a == transform<3>{} && move_b == transform<3>{})
            return build_overlap(a.faces, base::face_boxes(a.points), b.faces,
                                 base::face_boxes(b.points));
        return build_overlap(a.faces, base::face_boxes(a.points, move_a), b.faces,
                             base::face_boxes(b.points, move_b));
    } catch (const std::invalid_argument&) {  // a box, and so a face, that is not finite
        check_finite_faces_moved(name_a.c_str(), a, move_a);
        check_finite_faces_moved(name_b.c_str(), b, move_b);
        throw;
    }
}

}  // namespace treeform::detail::intersect
