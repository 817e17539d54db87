#pragma once
/// \file
/// The set operations behind `resolve_self_intersections`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// What one mesh became.
struct resolved_operand {
    boolean_result made{};
    /// [F] 1 for the faces of the mesh of which there is something in `made`, also where it was
    /// merged with a lower face. A face that lies on a lower one everywhere has nothing there.
    std::vector<std::uint8_t> is_left{};
};

/// `split` of one mesh, and its union with nothing; errors name `resolve_self_intersections`.
[[nodiscard]] resolved_operand resolve_by_split(mesh_view mesh, const boolean_options& options);
[[nodiscard]] resolved_operand resolve_by_union(mesh_view mesh, const boolean_options& options);

/// How cells were labeled, as in `labeled_cells`.
struct label_counts {
    std::uint64_t cells = 0;  ///< bounded ones
    double dropped_area = 0.0;
    double flipped_area = 0.0;
};

struct labeled_result {
    resolved_operand resolved{};
    label_counts counts{};
};

/// The cells of a mesh that may be open, and whose faces may disagree, with the labels that they
/// disagree with least.
///
/// \param is_guess [F] 1 for fillings that are there for the labels to use or not
[[nodiscard]] labeled_result resolve_by_labels(mesh_view mesh,
                                               std::span<const std::uint32_t> is_guess,
                                               const boolean_options& options);

}  // namespace treeform::detail::boolean
