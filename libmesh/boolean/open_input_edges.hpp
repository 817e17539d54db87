#pragma once
/// \file
/// The edges of operands, before they are cut, at which their surfaces are open.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::boolean {

struct open_input_edges {
    std::uint64_t boundary = 0;     ///< of an odd number of faces of the operand
    std::uint64_t misoriented = 0;  ///< of an even number, of which more run one way than the other
};

/// How many there are; none where a corner at one of them lies within another one of its operand,
/// for such edges may fit together piece by piece. The operand `sheet` may be open, and is left
/// out.
///
/// \pre  no two points of `joined` are equal; its coordinates are finite
/// \cost O(F + E log E) time for E such edges
[[nodiscard]] std::optional<open_input_edges> count_open_input_edges(
    mesh_view joined, std::span<const std::uint32_t> operand_of_face,
    std::uint32_t sheet = operand_element::none);

}  // namespace treeform::detail::boolean
