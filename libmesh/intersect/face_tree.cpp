#include <libmesh/detail/check_faces.hpp>
#include <libmesh/intersect/face_tree.hpp>
#include <libtree/build.hpp>

#include <limits>

namespace tf {
namespace {

/// The box of a face; one that no tree takes when a corner is not finite, which a box that only
/// grows would overlook in a NaN.
aabb<double, 3> box_of(mesh_view mesh, const face& f) {
    aabb<double, 3> box;
    double sum = 0.0;
    for (const std::uint32_t corner : f) {
        const point3& p = mesh.points[corner];
        box.include(p);
        for (std::size_t k = 0; k < 3; ++k) sum += 0.0 * p[k];
    }
    if (sum != 0.0) box.min[0] = std::numeric_limits<double>::quiet_NaN();
    return box;
}

}  // namespace

tree<3> face_tree(mesh_view mesh) {
    detail::check_faces("face_tree", mesh.points.size(), mesh.faces);
    return build(mesh.faces, [mesh](const face& f) { return box_of(mesh, f); });
}

}  // namespace tf
