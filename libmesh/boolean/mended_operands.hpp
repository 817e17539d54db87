#pragma once
/// \file
/// Operands that are moved a little where the result could not be rounded.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// What is asked of operands, and how the result is rounded: with `rounding_steps` steps.
struct rounding_try : boolean_options {
    // As in `round_options`.
    std::vector<double> grids{};
    round_options::joining join = round_options::joining::never;
    int most_rounds = 15;
    std::uint64_t most_meeting = std::numeric_limits<std::uint64_t>::max();
};

/// The answer to the operands as they are.
struct unmended_result {
    boolean_result result;
    /// Boxes of all faces that met after a step of mending or before; of faces as rounded.
    std::vector<aabb<double, 3>> broken{};
    bool on_grid = false;  ///< as in `rounded_surface`
};

/// What `ask` says of the operands; where that cannot be certified, of operands whose faces next to
/// what is broken are joined, further and further, as long as there are steps left. All but the
/// surface, its sources, its moves and what is certain about it is said of the operands as given.
///
/// Sheets that all but lie on each other meet, as they are, in a great many places that no rounded
/// coordinates can hold apart; joined, they are one sheet where they lie on each other.
///
/// \throws what `ask` throws
/// \same   on any number of threads, if `ask` is
[[nodiscard]] boolean_result with_mended_operands(
    std::span<const mesh_view> operands, const boolean_options& options,
    function_ref<unmended_result(std::span<const mesh_view>, const rounding_try&)> ask);

}  // namespace treeform::detail::boolean
