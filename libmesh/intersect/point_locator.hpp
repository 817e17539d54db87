#pragma once
/// \file
/// Locates points relative to a closed mesh with a given tree.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::intersect {

/// See `locate`. May be used from several threads at once.
class TREEFORM_API point_locator {
  public:
    /// `tree` is `build_face_tree(mesh)`; it and the arrays of `mesh` outlive the locator.
    ///
    /// \pre the mesh is closed (`find_open_edge`), the tree is of its faces
    point_locator(mesh_view mesh, const tree<3>& tree) : mesh_(mesh), tree_(&tree) {}

    /// \throws std::invalid_argument if a coordinate is not finite; so do the functions below
    [[nodiscard]] point_location locate(const point3& point) const;
    /// The winding number around the point of the faces for which `counts` returns true, which must
    /// be closed; none if the point is on one of them.
    [[nodiscard]] std::optional<std::int32_t> winding_of(
        const point3& point, function_ref<bool(std::uint32_t)> counts) const;
    /// [P]
    [[nodiscard]] std::vector<point_location> locate(std::span<const point3> points) const;

  private:
    mesh_view mesh_;
    const tree<3>* tree_;
};

/// \throws std::invalid_argument if the mesh is not closed
void check_closed(const char* function, mesh_view mesh);

/// Whether the mesh, with corners of equal coordinates joined, is closed; the mesh caches the
/// answer.
[[nodiscard]] bool is_closed(const prepared_mesh& mesh);

}  // namespace treeform::detail::intersect
