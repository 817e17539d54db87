#pragma once
/// \file
/// A mesh or cloud in the arrays of Python, as operations take it.

#include "arrays.hpp"

namespace binding {

/// Refers to arrays, and keeps them alive.
class held_mesh {
  public:
    /// `keep`: for many queries, so that indexes are kept (`prepared_mesh`).
    held_mesh(points_array points, faces_array faces, bool keep)
        : points_(std::move(points)),
          faces_(std::move(faces)),
          keep_(keep),
          view_{points_of(points_), rows_of<tf::face>(faces_)},
          prepared_(tf::prepared_mesh::borrow(view_)) {}
    /// A cloud.
    explicit held_mesh(points_array points)
        : points_(std::move(points)),
          faces_(std::vector<py::ssize_t>{0, 3}),
          keep_(true),
          view_{points_of(points_), {}},
          prepared_(tf::prepared_mesh::borrow_cloud(view_.points)) {}

    [[nodiscard]] const points_array& points() const { return points_; }
    [[nodiscard]] const faces_array& faces() const { return faces_; }
    /// The `file_data` of the mesh, or None.
    [[nodiscard]] const py::object& data() const { return data_; }
    void set_data(py::object data) { data_ = std::move(data); }
    [[nodiscard]] tf::mesh_view view() const { return view_; }
    [[nodiscard]] const tf::prepared_mesh& prepared() const { return prepared_; }
    [[nodiscard]] bool keep() const { return keep_; }
    [[nodiscard]] std::size_t size() const { return view_.points.size() + view_.faces.size(); }

    /// As verbs take it: the prepared mesh, or the view where no further query will come.
    [[nodiscard]] tf::mesh_ref ref() const {
        if (keep_ || prepared_.is_cloud()) return prepared_;
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

[[nodiscard]] inline tf::mesh_refs refs_of(const held_meshes& meshes) {
    std::vector<tf::mesh_ref> refs;
    for (const held_mesh* one : meshes) refs.push_back(one->ref());
    return refs;
}

[[nodiscard]] inline std::vector<tf::mesh_view> views_of(const held_meshes& meshes) {
    std::vector<tf::mesh_view> views;
    for (const held_mesh* one : meshes) views.push_back(one->view());
    return views;
}

/// All of them anew, without what has been indexed: for operations on many that take them in a row.
[[nodiscard]] inline std::vector<tf::prepared_mesh> borrowed(const held_meshes& meshes) {
    std::vector<tf::prepared_mesh> all;
    for (const held_mesh* one : meshes)
        all.push_back(one->prepared().is_cloud()
                          ? tf::prepared_mesh::borrow_cloud(one->view().points)
                          : tf::prepared_mesh::borrow(one->view()));
    return all;
}

}  // namespace binding
