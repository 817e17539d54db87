#pragma once
/// \file
/// A mesh with the indexes that queries ask for, each built on first use, once.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace treeform {

struct usable_mesh;

namespace detail::base {
class prepared_slots;
}

/// A mesh for many queries. Every query of meshes takes one in place of a `mesh_view` and gives the
/// same answers. The first query that needs an index (a tree over the faces, triangles in the order
/// of that tree, joined corners, whether the mesh is closed) builds it; later queries use it again.
///
/// Queries are const and may run on any threads at once. One of them builds an index; others that
/// need it in the meantime help. A build that is cancelled or fails leaves nothing behind.
///
/// Move-only. After a move, the source may only be destroyed or assigned to.
class TREEFORM_API prepared_mesh {
  public:
    /// No faces.
    prepared_mesh();
    /// Owns the arrays.
    explicit prepared_mesh(mesh&& owned);
    explicit prepared_mesh(usable_mesh&& owned);
    /// Refers to the caller's arrays, which must stay unchanged as long as this lives.
    [[nodiscard]] static prepared_mesh borrow(mesh_view view);
    static prepared_mesh borrow(mesh&&) = delete;  // gone before it is asked: let this own it

    /// A cloud of points, to be measured, slid and separated as meshes are. Each point is a
    /// degenerate face, so face numbers are point numbers. A cloud bounds no solid. It penetrates a
    /// mesh when a point lies strictly inside the solid that the mesh bounds, and touches the mesh
    /// when a point is on a face.
    [[nodiscard]] static prepared_mesh cloud(std::vector<point3>&& owned);
    /// The same, but refers to the caller's points, as `borrow` does.
    [[nodiscard]] static prepared_mesh borrow_cloud(points_view points);

    ~prepared_mesh();
    prepared_mesh(prepared_mesh&&) noexcept;
    prepared_mesh& operator=(prepared_mesh&&) noexcept;

    [[nodiscard]] mesh_view view() const { return view_; }
    [[nodiscard]] bool is_cloud() const { return cloud_; }

    /// Number of indexes built so far. A second query of the same kind does not change it.
    [[nodiscard]] std::uint64_t indexes_built() const;

  private:
    friend class detail::base::prepared_slots;
    struct state;

    mesh_view view_{};
    bool cloud_ = false;
    std::shared_ptr<state> state_;
};

}  // namespace treeform
