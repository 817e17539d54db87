#pragma once
/// \file
/// An exact surface without the edges and vertices that its shape does not need.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Which faces of a surface became one.
struct face_origins {
    std::vector<std::uint32_t> source;  ///< [F before] the face of the input that each lay in
    /// [F before] the lowest of the faces that were merged with each.
    std::vector<std::uint32_t> merged_into;
    std::vector<std::uint32_t> of_face;  ///< [F] the lowest face before that each one is made of

    /// Calls `mark(f)` for the faces of the input of which something is in `faces` of the surface.
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
/// Exact. Other faces stay, with all their corners. Merged ones are not certified.
///
/// \param input     whose faces were cut; points are those of `surface`
/// \param group_of  [faces of `input`] or empty: only faces of one group are merged
/// \param origins   receives what became one, where it is given, and anything is merged at all
/// \param source_of [F] the face of `input` that each face of the surface lies in, ascending; so it
///                  is afterwards, the lowest of those that were merged
/// \return for each constructed point, the lowest face of `input` among the sources at it; empty
///         where nothing was to be merged
/// \pre    as `merge_coplanar`; `surface.certified` has a value for each face
/// \cost   as `merge_coplanar` for the faces that are not certified, and O(F) to find them
/// \same   on any number of threads
std::vector<std::uint32_t> merge_cuts(exact_surface& surface, std::vector<std::uint32_t>& source_of,
                                      std::span<const face> input,
                                      std::span<const std::uint32_t> group_of,
                                      const boolean_options& options,
                                      face_origins* origins = nullptr);

}  // namespace treeform::detail::boolean
