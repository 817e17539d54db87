#pragma once
/// \file
/// Short translations that take a mesh out of others, or away from them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform {

struct clear_options {
    double clearance = 0.0;       ///< the least distance wanted; 0: not to penetrate
    std::size_t normals = 24;     ///< normals of faces that are tried as directions, at most
    std::size_t face_pairs = 64;  ///< pairs of faces whose normals are looked at, for each part
    progress_callback progress{};
};

/// A translation by `time` times `direction`.
struct clear_move {
    point3 direction{};  ///< of length 1, rounded
    double time = 0.0;   ///< its length
};

struct clear_result {
    std::vector<clear_move> moves{};  ///< the shortest first
    bool cancelled = false;           ///< `progress` said stop; `moves` is empty
};

/// Translations of `a` to places where it penetrates none of `parts` and keeps the clearance;
/// none when it does so where it is.
///
/// The directions tried are the six of the axes, those of the line between the nearest points, the
/// normals of faces that meet, their sum, and the way of a walk that steps out of the reach of the
/// nearest part until none is; then others around the best, ever closer to it. In each, some places
/// from near to far are looked at; from the first free one the mesh slides back, as `slide` does,
/// until contact or to the clearance. That need not be the least translation in a direction, nor
/// the best of all directions, which is a boundary point of a set with O(n^2 m^2) faces. At least
/// one is given: along an axis, past all boxes.
///
/// The places are those of exact translations but for rounding: `settle_among`, backing off
/// `forward`, decides in the coordinates that are written.
///
/// \pre    `tree_a` is `face_tree(a)`
/// \throws std::invalid_argument as `relation`, or when the clearance is negative or not finite
/// \cost   for each of some 50 directions up to a dozen `intersects` or `mesh_distance`, a
///         `face_tree` of `a` and a `slide`
/// \same   on any number of threads
/// \source why the least translation is no target: Dobkin, Hershberger, Kirkpatrick and Suri,
///         Computing the Intersection-Depth of Polyhedra, Algorithmica 9 (1993)
[[nodiscard]] TREEFORM_API clear_result clear_moves(mesh_view a, const tree<3>& tree_a,
                                                    std::span<const still_part> parts,
                                                    const clear_options& options = {});

}  // namespace treeform
