#pragma once
/// \file
/// Removes edges and vertices that the shape of an exact surface does not need.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Which faces of a surface were merged.
struct face_origins {
    std::vector<std::uint32_t> source;  ///< [F before] the input face that contains each
    /// [F before] the lowest face with which each was merged.
    std::vector<std::uint32_t> merged_into;
    /// [F] the lowest of the former faces of which each consists
    std::vector<std::uint32_t> of_face;

    /// Calls `mark(f)` for the input faces of which a part is in `faces` of the surface.
    template <class Mark>
    void for_sources_in(std::span<const std::uint32_t> faces, const Mark& mark) const {
        if (source.empty()) return;
        std::vector<std::uint8_t> is_there(source.size(), 0);
        for (const std::uint32_t f : faces)
            if (of_face[f] < source.size()) is_there[of_face[f]] = 1;
        for (std::size_t f = 0; f < source.size(); ++f)
            if (is_there[merged_into[f]] != 0) mark(source[f]);
    }
};

/// Whether any faces are to be merged.
[[nodiscard]] inline bool merges_faces(const boolean_options& options) {
    return options.merge_coplanar || !options.keep_cuts;
}

/// `options.face_groups` for the remaining faces of the operands; empty if there are no groups.
///
/// \param number_of_face [F] the number of each among those of all operands, or empty: all remain
/// \throws std::invalid_argument if there are groups, but not one for each of `count` faces
[[nodiscard]] std::vector<std::uint32_t> groups_of(const boolean_options& options,
                                                   std::span<const std::uint32_t> number_of_face,
                                                   std::size_t count);

/// Merges coplanar faces of the surface that were cut, or overlap. Removes edges between them, and
/// vertices inside a merged region or on a straight edge between the same two regions. With
/// `simplify`, merges all coplanar faces. Nothing changes with `keep_cuts`.
///
/// Exact. Other faces keep all their corners. Merged faces are not certified.
///
/// \param input     the faces that were cut; their points are those of `surface`
/// \param group_of  [faces of `input`] or empty: only faces of one group are merged
/// \param origins   if not null, receives which faces were merged, if any
/// \param source_of [F] the face of `input` that contains each face of the surface, ascending;
///                  afterwards, the lowest of the merged ones
/// \return for each constructed point, the lowest face of `input` among the sources at it; empty if
///         nothing was to be merged
/// \pre    as `merge_coplanar`; `surface.certified` has a value for each face
/// \cost   as `merge_coplanar` for the faces that are not certified, and O(F) to find them
/// \same   on any number of threads
std::vector<std::uint32_t> merge_cuts(exact_surface& surface, std::vector<std::uint32_t>& source_of,
                                      std::span<const face> input,
                                      std::span<const std::uint32_t> group_of,
                                      const boolean_options& options,
                                      face_origins* origins = nullptr);

}  // namespace treeform::detail::boolean
