#pragma once
/// \file
/// An exact surface without the edges and vertices that its shape does not need.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Whether any faces are to be merged.
[[nodiscard]] inline bool merges_faces(const boolean_options& options) {
    return options.simplify || !options.keep_cuts;
}

/// `options.face_groups` of the faces that are left of the operands, or none where there are none.
///
/// \param number_of_face [F] the number of each among those of all operands, or empty: all are left
/// \throws std::invalid_argument when there are groups, but not `count` of them, one for each face
[[nodiscard]] std::vector<std::uint32_t> groups_of(const boolean_options& options,
                                                   std::span<const std::uint32_t> number_of_face,
                                                   std::size_t count);

/// Makes one of coplanar faces of the surface that were cut, or overlap: edges between them go, and
/// so do vertices that only such faces have, inside of them or on a straight edge between the same
/// two. With `simplify`, of all coplanar faces. Nothing changes with `keep_cuts`.
///
/// Exact. Other faces stay, with all their corners. Merged ones are not sound.
///
/// \param input     whose faces were cut; points are those of `surface`
/// \param group_of  [faces of `input`] or empty: only faces of one group are merged
/// \param source_of [F] the face of `input` that each face of the surface lies in, ascending; so it
///                  is afterwards, the lowest of those that were merged
/// \return for each constructed point, the lowest face of `input` among the sources at it; empty
///         where nothing was to be merged
/// \pre    as `merge_coplanar`; `surface.sound` has a value for each face
/// \cost   as `merge_coplanar` for the faces that are not sound, and O(F) to find them
/// \same   on any number of threads
std::vector<std::uint32_t> merge_cuts(exact_surface& surface, std::vector<std::uint32_t>& source_of,
                                      std::span<const face> input,
                                      std::span<const std::uint32_t> group_of,
                                      const boolean_options& options);

}  // namespace treeform::detail::boolean
