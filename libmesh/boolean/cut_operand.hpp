#pragma once
/// \file
/// Operands in the form in which they are cut, and what is known about them before.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/open_input_edges.hpp>
#include <libmesh/intersect/pairs_by_tree.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Thrown if `progress` returned false, so that a prepared mesh caches no partial result.
struct stopped {};

/// One operand, or several as one mesh, in which no two points are equal, all points are corners,
/// and no face is degenerate.
struct cut_operand {
    joined_operands joined{};            ///< empty if the given mesh already has this form
    std::optional<prepared_mesh> own{};  ///< prepared mesh of `joined.all`, unless that is empty
    std::uint64_t degenerate = 0;        ///< number of faces without area, omitted
    open_input_edges open{};
    /// Points whose faces are not one closed fan, ascending.
    std::vector<std::uint32_t> without_fan{};

    /// \param given the mesh from which this was made
    [[nodiscard]] const prepared_mesh& mesh(const prepared_mesh& given) const {
        return own ? *own : given;
    }
};

/// The operand of a prepared mesh, which caches it.
///
/// \throws std::invalid_argument for a corner that is not finite or beyond 2^1000
/// \pre    the operand has been checked
/// \cost   O(V + F) once; more if points are equal or the surface is not manifold
/// \same   on any number of threads
[[nodiscard]] const cut_operand& cut_operand_of(const prepared_mesh& mesh);

/// The operand of joined operands.
///
/// \param is_closed skip the search for open edges: the operands are closed, perhaps together with
///        omitted faces
[[nodiscard]] cut_operand cut_operand_of(joined_operands&& joined, bool is_closed);

/// The pairs of a mesh's own faces that meet beyond shared corners, ascending; none if there is
/// more than one pair for every 16 faces. The mesh caches the result.
///
/// \throws stopped
/// \cost   that of `self_intersections`, once
[[nodiscard]] std::optional<std::span<const face_pair>> few_own_pairs(
    const prepared_mesh& mesh, const progress_callback& progress);

/// The same for any number of pairs.
[[nodiscard]] std::span<const face_pair> own_pairs(const prepared_mesh& mesh,
                                                   const progress_callback& progress);

/// Only the wanted pairs.
[[nodiscard]] std::vector<face_pair> own_pairs(const prepared_mesh& mesh,
                                               const intersect::wanted_pairs& wanted,
                                               const progress_callback& progress);

}  // namespace treeform::detail::boolean
