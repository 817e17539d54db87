#pragma once
/// \file
/// The set operations behind `resolve_self_intersections`.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::boolean {

/// `split` of one mesh, and its union with nothing; errors name `resolve_self_intersections`.
[[nodiscard]] boolean_result resolve_by_split(mesh_view mesh, const boolean_options& options);
[[nodiscard]] boolean_result resolve_by_union(mesh_view mesh, const boolean_options& options);

/// How cells were labeled, as in `labeled_cells`.
struct label_counts {
    std::uint64_t cells = 0;  ///< bounded ones
    double dropped_area = 0.0;
    double turned_area = 0.0;
};

struct labeled_result {
    boolean_result made;
    label_counts counts{};
};

/// The cells of a mesh that may be open, and whose faces may disagree, with the labels that they
/// disagree with least. `options.face_groups` says 1 of fillings and 0 of other faces, of each face.
[[nodiscard]] labeled_result resolve_by_labels(mesh_view mesh, const boolean_options& options);

}  // namespace treeform::detail::boolean
