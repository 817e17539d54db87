#pragma once
/// \file
/// The parts of a file that are repaired separately.

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
    std::vector<std::uint32_t> faces{};   ///< [F] face numbers in the file, ascending
    std::vector<std::uint32_t> points{};  ///< [V] point numbers in the file, ascending
};

/// The parts of a file with its own vertex numbers (`scene_parts`). Two parts are merged if a
/// border edge of one (an edge with one face of the part) has the same coordinates as a border edge
/// of the other: they are patches of one surface. Solids that touch are not merged. Parts are in
/// the order of their lowest faces; faces in a part ascend. The box of a merged part is that of its
/// first part.
///
/// \cost O(V log V + F log F)
[[nodiscard]] std::vector<scene_part> surface_parts(const carry_source& input);

/// The same, with the points of each part; empty if there is only one part.
[[nodiscard]] std::vector<solid_part> solid_parts(const carry_source& input);

}  // namespace treeform::detail::carry
