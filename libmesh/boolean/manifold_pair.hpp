#pragma once
/// \file
/// Set operations on two closed manifolds, few faces of which meet.

#include <libmesh/boolean/near_faces.hpp>
#include <libmesh/boolean/pair_surface.hpp>
#include <treeform/mesh/boolean.hpp>

#include <optional>

namespace treeform::detail::boolean {

/// What `boolean` gives for two operands that are manifolds (`examine_operand`), except for the count
/// of cells: only faces near others that they meet are arranged, the rest is copied. Faces may meet
/// within an operand, and wind around places any number of times.
///
/// Faces that are not near any meeting and have a common point lie alike; so do the sides of
/// patches near it that look into one region. One line for each of these sets tells how often both
/// operands wind around it.
///
/// \param operands  of one alone, the second is a mesh without faces
/// \param own  of each operand, all pairs of its faces that meet beyond shared corners, ascending
/// \param once as in `find_near_faces`
/// \return none where only the general way will do: float32 or volumes are asked for, or rounding
///         has broken something
/// \same  on any number of threads
/// \source winding numbers by patch: Zhou, Grinspun, Zorin and Jacobson, Mesh Arrangements for Solid
///         Geometry, SIGGRAPH 2016; here of what is near alone
[[nodiscard]] std::optional<pair_result> boolean_of_manifold_pair(
    const prepared_pair& operands, const own_pairs& own, bool once,
    const boolean_expression& expression, const boolean_options& options);

}  // namespace treeform::detail::boolean
