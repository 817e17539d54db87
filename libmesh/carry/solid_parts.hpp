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

/// The parts of a file, as of `split_parts`, with their points; empty where there is but one.
[[nodiscard]] std::vector<solid_part> solid_parts(const carry_source& input);

}  // namespace treeform::detail::carry
