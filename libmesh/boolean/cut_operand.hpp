#pragma once
/// \file
/// Operands in the shape in which they are cut, and what is known of them before.

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

/// Thrown where `progress` asked to stop: a mesh then keeps no answer.
struct stopped {};

/// One operand, or several as one mesh, of which no two points are equal, all points are corners,
/// and all faces have an area.
struct cut_operand {
    joined_operands joined{};            ///< empty where the mesh is so as it was given
    std::optional<prepared_mesh> own{};  ///< of `joined.all`, where that is not empty
    std::uint64_t degenerate = 0;        ///< faces without an area, left out
    open_input_edges open{};
    /// Points whose faces are not one closed fan, ascending.
    std::vector<std::uint32_t> without_fan{};

    /// \param given the mesh that this is of
    [[nodiscard]] const prepared_mesh& mesh(const prepared_mesh& given) const {
        return own ? *own : given;
    }
};

/// What a prepared mesh is cut as; it keeps the answer.
///
/// \throws std::invalid_argument for a corner that is not finite or beyond 2^1000
/// \pre    the operand has been checked
/// \cost   O(V + F) once; more where points are equal or surfaces are not manifold
/// \same   on any number of threads
[[nodiscard]] const cut_operand& cut_operand_of(const prepared_mesh& mesh);

/// What operands that were joined are cut as.
///
/// \param is_closed whether nobody need look where they end, as what is left out closes them,
///        perhaps
[[nodiscard]] cut_operand cut_operand_of(joined_operands&& joined, bool is_closed);

/// The pairs of a mesh's own faces that meet beyond shared corners, ascending; none where there are
/// more than a pair for each 16 faces. The mesh keeps the answer.
///
/// \throws stopped
/// \cost   that of `self_intersections`, once
[[nodiscard]] std::optional<std::span<const face_pair>> few_own_pairs(
    const prepared_mesh& mesh, const progress_callback& progress);

/// The same however many there are.
[[nodiscard]] std::span<const face_pair> own_pairs(const prepared_mesh& mesh,
                                                   const progress_callback& progress);

/// Those that are wanted.
[[nodiscard]] std::vector<face_pair> own_pairs(const prepared_mesh& mesh,
                                               const intersect::wanted_pairs& wanted,
                                               const progress_callback& progress);

}  // namespace treeform::detail::boolean
