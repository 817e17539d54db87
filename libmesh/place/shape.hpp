#pragma once
/// \file
/// A placed mesh, the operand of the queries in this folder.

#include <libmesh/base/build_face_tree.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/tree.hpp>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::place {

/// A handle of a mesh at its own position or with moved points. Owns nothing. Data that depends on
/// connectivity only is computed once, for the mesh at its own position.
class shape {
  public:
    explicit shape(const prepared_mesh& mesh,
                   vertex_identity vertices = vertex_identity::by_coordinates)
        : prepared_(&mesh), points_(mesh.indexed_view().points), vertices_(vertices) {}
    /// `mesh` with the moved points `there`; `mirrored` if the motion is a reflection.
    /// \pre `faces` is `build_face_tree` of the moved mesh
    shape(const prepared_mesh& mesh, points_view there, const tree<3>& faces,
          vertex_identity vertices = vertex_identity::by_coordinates, bool mirrored = false)
        : prepared_(&mesh),
          points_(there),
          faces_(&faces),
          vertices_(vertices),
          mirrored_(mirrored) {}

    [[nodiscard]] mesh_view mesh() const { return {points_, prepared_->indexed_view().faces}; }
    [[nodiscard]] const tree<3>& faces() const {
        return faces_ ? *faces_ : build_face_tree(*prepared_);
    }
    /// The mesh with one point number for the corners of each vertex.
    [[nodiscard]] mesh_view joined() const;
    /// Whether every edge has equally many faces in both directions (`find_open_edge`).
    [[nodiscard]] bool closed() const;
    [[nodiscard]] vertex_identity vertices() const { return vertices_; }
    [[nodiscard]] bool mirrored() const { return mirrored_; }
    [[nodiscard]] const prepared_mesh& prepared() const { return *prepared_; }

  private:
    const prepared_mesh* prepared_;
    points_view points_;
    const tree<3>* faces_ = nullptr;
    vertex_identity vertices_;
    bool mirrored_ = false;
};

/// \throws std::invalid_argument naming the lowest face of `mesh` with a corner out of range or
///         not finite; `function` is "slide", the message "treeform::slide: fixed 3: face 5 ..."
void check_operand(const std::string& function, const std::string& operand, mesh_view mesh);

/// The same for a mesh whose face tree is needed; building the tree checks the mesh, once.
void check_operand(const std::string& function, const std::string& operand,
                   const prepared_mesh& mesh);

/// \throws std::invalid_argument for the first of the points that is not finite, an `of`
void check_finite(const std::string& function, points_view points, const std::string& of = "point");
/// \throws std::invalid_argument for a motion that is zero or not finite
void check_motion(const std::string& function, const point3& motion);

/// Neither overflows nor vanishes on the way.
[[nodiscard]] inline double length_of(const point3& v) { return std::hypot(v.x, v.y, v.z); }
/// Of length 1; 0 where there is no direction.
[[nodiscard]] point3 unit_of(const point3& v);
/// The same of the normal of a triangle.
[[nodiscard]] point3 normal_of(const triangle3& t);

/// The box of the points that faces use; empty without faces.
[[nodiscard]] std::optional<box3> box_of_faces(mesh_view mesh);

/// The least value of the precision `of` that is not below `x`; infinite if there is none.
[[nodiscard]] double not_below(double x, precision of);

/// Whether the boxes are within `distance` of each other along each axis.
[[nodiscard]] bool within(const box3& a, const box3& b, double distance);

}  // namespace treeform::detail::place
