#pragma once
/// \file
/// The parts of a file that are mended one by one.

#include <libmesh/attributes/scene_parts.hpp>
#include <treeform/mesh/carry.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace treeform::detail::carry {

/// A part with its own points.
struct solid_part {
    std::string name{};
    treeform::mesh mesh{};
    std::vector<std::uint32_t> faces{};   ///< [F] in the whole, ascending
    std::vector<std::uint32_t> points{};  ///< [V] in the whole, ascending
};

/// The parts of a file as it numbers its vertices (`scene_parts`), those as one of which an edge
/// with one face of the part has the coordinates of such an edge of the other: they are patches of
/// one surface. Solids that touch stay apart. In the order of their lowest faces, which are
/// ascending; of parts that are one, the box is that of the first.
///
/// \cost O(V log V + F log F)
[[nodiscard]] std::vector<scene_part> surface_parts(const carry_source& input);

/// The same with their points; empty where there is but one.
[[nodiscard]] std::vector<solid_part> solid_parts(const carry_source& input);

}  // namespace treeform::detail::carry
