#pragma once
/// \file
/// Rays against one mesh whose tree is known.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::intersect {

/// Rays against one mesh, as many as wanted; for several threads at once.
///
/// Every answer is exact: which faces a ray meets, what part of each, and in which order; only the
/// numbers t are rounded. A ray that meets an edge or corner meets each face that has it, so a
/// ray through a vertex of six faces has six hits there, at equal t, each with its own name for
/// the vertex. Faces are closed, have two sides, and count in either orientation.
class TREEFORM_API ray_query {
  public:
    /// `tree` is `build_face_tree(mesh)`; it and the arrays of `mesh` outlive the query.
    ///
    /// \throws std::invalid_argument when the tree is not of as many faces
    ray_query(mesh_view mesh, const tree<3>& tree);

    /// The face met first: of several at one point that of the lowest number.
    ///
    /// \throws std::invalid_argument for a ray with a number that is not finite, except for
    ///         infinite parameters, or of zero direction; likewise below, naming the ray
    /// \cost   O(log F) and the faces at the hit, for most rays
    [[nodiscard]] std::optional<mesh_hit> first(const ray3& ray) const;

    /// All faces met, in the order of their exact parameters, then by number.
    [[nodiscard]] std::vector<mesh_hit> all(const ray3& ray) const;

    /// Whether any face is met.
    [[nodiscard]] bool any(const ray3& ray) const;

    /// [R] the same for many rays, in their order.
    /// \same on any number of threads
    [[nodiscard]] std::vector<std::optional<mesh_hit>> first(std::span<const ray3> rays) const;
    [[nodiscard]] answer_lists<mesh_hit> all(std::span<const ray3> rays) const;
    /// [R] 1 where any face is met, else 0.
    [[nodiscard]] std::vector<std::uint8_t> any(std::span<const ray3> rays) const;

  private:
    [[nodiscard]] triangle3 corners(std::uint32_t id) const;

    mesh_view mesh_;
    const tree<3>* tree_;
};

}  // namespace treeform::detail::intersect
