#pragma once
/// \file
/// From faces of an arrangement to a result in rounded coordinates.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/round/solid_faces.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// [F] of the single operand as given, or null: set to 1 for faces that were merged with lower ones,
/// where something is left of what they became. Those that `face_source` names need not be set.
using left_faces = std::vector<std::uint8_t>*;

/// What an arrangement counts; the status is that of a result which is not there yet.
[[nodiscard]] boolean_result with_counts(const arrange_faces_result& arranged);

/// Makes faces of `cut` the surface of `result`: simplified where that is asked for, rounded, checked,
/// and with the operands' faces and vertices that it comes from.
///
/// What is not needed any more is let go on the way: `cut` and `joined.all` are empty then.
///
/// \param solid whether it bounds a solid
/// \throws std::invalid_argument when there are face groups, but not as many as faces
void finish_surface(boolean_result& result, mesh_arrangement& cut, round::solid_faces chosen,
                    joined_operands& joined, bool solid, const boolean_options& options,
                    left_faces is_left = nullptr);

/// Brings faces into the order of their sources, which is theirs but where rounded faces were cut.
void sort_by_source(std::vector<std::uint32_t>& source, std::vector<face>& faces);

}  // namespace treeform::detail::boolean
