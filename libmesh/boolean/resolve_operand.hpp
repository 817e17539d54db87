#pragma once
/// \file
/// The set operations behind `resolve_self_intersections`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The resolved mesh.
struct resolved_operand {
    boolean_result made{};
    /// [F] 1 for the faces of the mesh of which a part is in `made`, even if it was merged with a
    /// lower face; 0 for a face that lies entirely on lower ones.
    std::vector<std::uint8_t> is_kept{};
};

/// `split` of one mesh, and its union with nothing; errors name `resolve_self_intersections`.
[[nodiscard]] resolved_operand resolve_by_split(mesh_view mesh, const boolean_options& options);
[[nodiscard]] resolved_operand resolve_by_union(mesh_view mesh, const boolean_options& options);

/// Counts of the labeling, as in `labeled_cells`.
struct label_counts {
    std::uint64_t cells = 0;  ///< number of bounded cells
    double dropped_area = 0.0;
    double flipped_area = 0.0;
};

struct labeled_result {
    resolved_operand resolved{};
    label_counts counts{};
};

/// The solid of the cells labeled inside, for a mesh that may be open and inconsistent
/// (`label_cells`).
///
/// \param is_guess [F] 1 for fillings that the labels may use or not
[[nodiscard]] labeled_result resolve_by_labels(mesh_view mesh,
                                               std::span<const std::uint32_t> is_guess,
                                               const boolean_options& options);

}  // namespace treeform::detail::boolean
