#pragma once
/// \file
/// A mesh or cloud in arrays of Python.

#include "arrays.hpp"

namespace binding {

/// Keeps the arrays alive.
class held_mesh {
  public:
    /// `keep`: indexes are kept for later queries (`prepared_mesh`).
    held_mesh(points_array points, faces_array faces, bool keep)
        : points_(std::move(points)),
          faces_(std::move(faces)),
          keep_(keep),
          view_{points_of(points_), rows_of<tf::face>(faces_)},
          prepared_(tf::prepared_mesh::borrow(view_)) {}
    /// A point cloud.
    explicit held_mesh(points_array points)
        : points_(std::move(points)),
          faces_(std::vector<py::ssize_t>{0, 3}),
          keep_(true),
          view_{points_of(points_), {}},
          prepared_(tf::prepared_mesh::borrow(view_)) {}

    [[nodiscard]] const points_array& points() const { return points_; }
    [[nodiscard]] const faces_array& faces() const { return faces_; }
    /// The `file_data` of the mesh, or None.
    [[nodiscard]] const py::object& data() const { return data_; }
    void set_data(py::object data) { data_ = std::move(data); }
    [[nodiscard]] tf::mesh_view view() const { return view_; }
    [[nodiscard]] const tf::prepared_mesh& prepared() const { return prepared_; }
    [[nodiscard]] bool keep() const { return keep_; }
    [[nodiscard]] std::size_t size() const { return view_.points.size() + view_.faces.size(); }

    /// A prepared mesh of its own, without indexes.
    [[nodiscard]] tf::prepared_mesh borrowed() const { return tf::prepared_mesh::borrow(view_); }

    /// The prepared mesh, or the view if there will be no further queries.
    [[nodiscard]] tf::mesh_ref ref() const {
        if (keep_) return prepared_;
        return view_;
    }

  private:
    points_array points_;
    faces_array faces_;
    py::object data_ = py::none();
    bool keep_;
    tf::mesh_view view_;
    tf::prepared_mesh prepared_;
};

using held_meshes = std::vector<const held_mesh*>;

[[nodiscard]] inline auto refs_of(const held_meshes& meshes) {
    return list_of(meshes, &held_mesh::ref);
}
[[nodiscard]] inline auto borrowed(const held_meshes& meshes) {
    return list_of(meshes, &held_mesh::borrowed);
}

}  // namespace binding
