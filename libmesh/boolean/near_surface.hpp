#pragma once
/// \file
/// Assembles the surface of a result from cut faces and unchanged faces.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <treeform/mesh/boolean.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// [F of the single operand as given] or null: set to 1 for faces that were merged with lower ones
/// of which a part is left. Faces in `face_source` need not be set.
using left_faces = std::vector<std::uint8_t>*;

struct near_result {
    boolean_result result{};
    bool is_manifold = false;  ///< whether the faces at every vertex are known to be one closed fan

    /// Whether to continue. If `progress` returns false, sets the status of the result.
    [[nodiscard]] bool may_continue(const progress_callback& progress, double done) {
        if (!progress || progress(done)) return true;
        result.certificate.status = status::cancelled;
        return false;
    }
};

/// The chosen faces of an arrangement, rounded, and the chosen faces that were not cut, unchanged;
/// in the order of the operands' faces.
///
/// Only near faces are processed, unless all faces may move or be merged, or rounded faces meet
/// other faces.
///
/// \param near     all members except the pairs and points of `local`; consumed, like the other
///        arguments
/// \param arranged of `near.local`
/// \param solid    whether the faces bound a solid
/// \same  on any number of threads
[[nodiscard]] near_result surface_of(const bundles& operands, interaction_zone& near,
                                     arrange_faces_result& arranged, chosen_surface chosen,
                                     const boolean_options& options, bool solid = true,
                                     left_faces is_kept = nullptr);

}  // namespace treeform::detail::boolean
