#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/point_location.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace treeform::detail::place {

mesh_view shape::joined() const {
    // A cloud bounds nothing, joined or not.
    if (vertices_ == vertex_identity::by_index || prepared_->is_cloud()) return mesh();
    return weld::join_faces(*prepared_).of(mesh());
}

bool shape::closed() const {
    if (vertices_ == vertex_identity::by_index)
        return !prepared_->is_cloud() && !find_open_edge(mesh());
    return intersect::is_closed(*prepared_);
}

void check_operand(const std::string& function, const std::string& operand, mesh_view mesh) {
    const std::string name = function + ": " + operand;
    base::check_faces(name.c_str(), mesh.points.size(), mesh.faces);
    base::check_finite_faces(name.c_str(), mesh);
}

void check_operand(const std::string& function, const std::string& operand,
                   const prepared_mesh& mesh) {
    static_cast<void>(build_face_tree(mesh, (function + ": " + operand).c_str()));
}

void check_motion(const std::string& function, const point3& motion) {
    if (!base::is_finite(motion) || motion == point3{})
        throw std::invalid_argument("treeform::" + function + ": the motion is zero or not finite");
}

void check_finite(const std::string& function, points_view points, const std::string& of) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!base::is_finite(points[i]))
            throw std::invalid_argument("treeform::" + function + ": " + of + " " +
                                        std::to_string(i) + " is not finite");
}

point3 unit_of(const point3& v) {
    const double size = length_of(v);
    if (!(size > 0.0) || !std::isfinite(size)) return {};
    return {v.x / size, v.y / size, v.z / size};
}

point3 normal_of(const triangle3& t) {
    return unit_of(base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0])));
}

std::optional<box3> box_of_faces(mesh_view mesh) {
    if (mesh.faces.empty()) return std::nullopt;
    const point3& first = mesh.points[mesh.faces[0][0]];
    box3 box{first, first};
    for (const face& f : mesh.faces)
        for (const std::uint32_t i : f)
            for (std::size_t k = 0; k < 3; ++k) {
                box.min[k] = std::min(box.min[k], mesh.points[i][k]);
                box.max[k] = std::max(box.max[k], mesh.points[i][k]);
            }
    return box;
}

double not_below(double x, precision of) {
    if (of == precision::float64) return x;
    const double nearest = base::nearest_float(x);
    if (nearest >= x) return nearest;
    return static_cast<double>(
        std::nextafterf(static_cast<float>(nearest), std::numeric_limits<float>::infinity()));
}

bool within(const box3& a, const box3& b, double distance) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(a.min[k] - b.max[k] <= distance && b.min[k] - a.max[k] <= distance)) return false;
    return true;
}

}  // namespace treeform::detail::place
