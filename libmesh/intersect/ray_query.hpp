#pragma once
/// \file
/// Casts rays into a mesh with a given tree.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::intersect {

/// Ray casting into one mesh. May be used from several threads at once.
///
/// The faces that a ray hits, the corner, edge or interior hit, and their order are exact; only the
/// parameters t are rounded. A ray that hits an edge or a corner hits every face there: through a
/// vertex of six faces it has six hits at equal t, each with the vertex as a corner of its face.
/// Faces include their edges, and are hit from both sides.
class TREEFORM_API ray_query {
  public:
    /// `tree` is `build_face_tree(mesh)`; it and the arrays of `mesh` outlive the query.
    ///
    /// \throws std::invalid_argument if the tree has another number of faces
    ray_query(mesh_view mesh, const tree<3>& tree);

    /// The first face hit; of several faces at the same point, the lowest number.
    ///
    /// \throws std::invalid_argument for a ray with a zero direction, or a number that is not
    ///         finite (t_min and t_max may be infinite); so do the functions below, naming the ray
    /// \cost   O(log F) plus the faces at the hit, for most rays
    [[nodiscard]] std::optional<mesh_hit> first(const ray3& ray) const;

    /// All faces hit, in the exact order along the ray, then by number.
    [[nodiscard]] std::vector<mesh_hit> all(const ray3& ray) const;

    /// Whether any face is hit.
    [[nodiscard]] bool any(const ray3& ray) const;

    /// [R] the same for many rays, in their order.
    /// \same on any number of threads
    [[nodiscard]] std::vector<std::optional<mesh_hit>> first(std::span<const ray3> rays) const;
    [[nodiscard]] answer_lists<mesh_hit> all(std::span<const ray3> rays) const;
    /// [R] 1 if any face is hit, else 0.
    [[nodiscard]] std::vector<std::uint8_t> any(std::span<const ray3> rays) const;

  private:
    [[nodiscard]] triangle3 corners(std::uint32_t id) const;

    mesh_view mesh_;
    const tree<3>* tree_;
};

}  // namespace treeform::detail::intersect
