#pragma once
/// \file
/// Points against one closed mesh whose tree is known.

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

/// As many points as wanted; for several threads at once. See `locate`.
class TREEFORM_API point_locator {
  public:
    /// `tree` is `build_face_tree(mesh)`; it and the arrays of `mesh` outlive the locator.
    ///
    /// \pre the mesh is closed (`find_open_edge`), the tree is of its faces
    point_locator(mesh_view mesh, const tree<3>& tree) : mesh_(mesh), tree_(&tree) {}

    /// \throws std::invalid_argument when a coordinate is not finite; likewise below
    [[nodiscard]] point_location locate(const point3& point) const;
    /// How often the faces that `counts` names, which are closed, wind around the point; none where
    /// one of them holds it.
    [[nodiscard]] std::optional<std::int32_t> winding_of(
        const point3& point, function_ref<bool(std::uint32_t)> counts) const;
    /// [P]
    [[nodiscard]] std::vector<point_location> locate(std::span<const point3> points) const;

  private:
    mesh_view mesh_;
    const tree<3>* tree_;
};

/// \throws std::invalid_argument when the mesh is not closed
void check_closed(const char* function, mesh_view mesh);

/// Whether the mesh, with corners of equal coordinates joined, is closed; it keeps the answer.
[[nodiscard]] bool is_closed(const prepared_mesh& mesh);

}  // namespace treeform::detail::intersect
