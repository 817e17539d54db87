#pragma once
/// \file
/// The surface of a result, from faces that were cut and faces that need not be.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <treeform/mesh/boolean.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// [F] of the single operand as given, or null: set to 1 for faces that were merged with lower
/// ones, where something is left of what they became. Those that `face_source` names need not be
/// set.
using left_faces = std::vector<std::uint8_t>*;

struct near_result {
    boolean_result result{};
    bool is_manifold = false;  ///< the faces at every vertex are certainly one closed fan

    /// Whether to go on. Where `progress` asks to stop, the result says so.
    [[nodiscard]] bool goes_on(const progress_callback& progress, double done) {
        if (!progress || progress(done)) return true;
        result.certificate.status = status::cancelled;
        return false;
    }
};

/// The chosen faces of an arrangement, rounded, and between them the faces that were not cut, as
/// they were; in the order of the operands' faces.
///
/// All faces are looked at where all may move or be merged, and where what was rounded meets
/// something: else what is near alone.
///
/// \param near     all but the pairs and points of `local`; is used up, as the others are
/// \param arranged of `near.local`
/// \param solid    whether the faces bound a solid
/// \same  on any number of threads
[[nodiscard]] near_result surface_of(const bundles& operands, interaction_zone& near,
                                     arrange_faces_result& arranged, chosen_surface chosen,
                                     const boolean_options& options, bool solid = true,
                                     left_faces is_left = nullptr);

}  // namespace treeform::detail::boolean
