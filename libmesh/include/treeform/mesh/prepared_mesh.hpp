#pragma once
/// \file
/// A mesh with the indexes that queries ask for, each built on first use, once.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace treeform {

namespace detail::base {
class prepared_slots;
}

/// For a mesh that is asked about more than once. Every query of meshes takes one in place of a
/// `mesh_view`; it builds the index that it needs (a tree over the faces, triangles in the order of
/// that tree, joined corners, whether the mesh is closed) when it first needs it, and later ones
/// find it there. Answers are the same as those of the view.
///
/// Queries are const and may run on any threads at once: an index is built by one of them, and
/// those that want it meanwhile help. A build that is cancelled or fails leaves nothing behind.
///
/// Move-only. One that has been moved from may only be destroyed or assigned to.
class TREEFORM_API prepared_mesh {
  public:
    /// No faces.
    prepared_mesh();
    /// Owns the arrays.
    explicit prepared_mesh(mesh&& owned);
    /// Refers to arrays of the caller, who keeps them, unchanged, while this lives.
    [[nodiscard]] static prepared_mesh borrow(mesh_view view);
    static prepared_mesh borrow(mesh&&) = delete;  // gone before it is asked: let this own it

    /// A cloud: each point is a face of that corner alone, so that clouds are related, measured,
    /// slid and separated as meshes are, and face numbers are those of the points. A cloud bounds
    /// nothing: it penetrates a mesh when a point lies strictly inside of the solid that the mesh
    /// bounds, and touches it when one is on a face.
    [[nodiscard]] static prepared_mesh cloud(std::vector<point3>&& owned);
    /// The same of points of the caller, who keeps them.
    [[nodiscard]] static prepared_mesh borrow_cloud(points_view points);

    ~prepared_mesh();
    prepared_mesh(prepared_mesh&&) noexcept;
    prepared_mesh& operator=(prepared_mesh&&) noexcept;

    [[nodiscard]] mesh_view view() const { return view_; }
    [[nodiscard]] bool is_cloud() const { return cloud_; }

    /// Indexes built so far: a second query of a kind leaves it as it was.
    [[nodiscard]] std::uint64_t indexes_built() const;

  private:
    friend class detail::base::prepared_slots;
    struct state;

    mesh_view view_{};
    bool cloud_ = false;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
