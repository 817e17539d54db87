#pragma once
/// \file
/// Whether an operand bounds a solid, and what needs no second look.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// As `treeform::check_solid`; errors name the function `called`.
[[nodiscard]] certificate check_solid(const char* called, mesh_view mesh,
                                      const progress_callback& progress = {});

/// Thrown where `progress` asked to stop: the mesh then keeps no answer.
struct stopped {};

/// What is known of an operand before it is cut.
struct examined_operand {
    enum class kind : std::uint8_t {
        unknown,   ///< anything else
        manifold,  ///< closed, one fan of faces at each vertex, few of which meet
        sound      ///< and none, and what is behind the faces is inside
    } is = kind::unknown;
    std::vector<face_pair> pairs{};  ///< of a manifold, that meet beyond shared corners, ascending
};

/// A manifold has no degenerate face and no two vertices with equal coordinates. Sound is, in
/// addition, what `boolean` has certified. The mesh keeps the answer. Unknown are also some that
/// would be manifold: with a vertex of more than 64 faces, or with more than a pair for each 16
/// faces. Not sound are also some that would be: with all but no volume.
///
/// \throws std::invalid_argument naming a face with a corner out of range; stopped
/// \cost   once, that of `self_intersections` and half as much
/// \same   on any number of threads
[[nodiscard]] const examined_operand& examine_operand(const prepared_mesh& mesh,
                                                      const progress_callback& progress);

}  // namespace treeform::detail::boolean
