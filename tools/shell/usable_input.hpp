#pragma once
/// \file
/// A mesh file as tools that cut it take it.

#include "tools/shell/run.hpp"
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <vector>

namespace tools {

/// A file, and its triangles that can be computed with.
struct usable_input {
    tf::mesh_file file{};
    std::vector<std::uint32_t> triangle_of_face{};  ///< in the file; empty: the same
    std::uint64_t non_finite = 0;                   ///< triangles with a corner that is not finite

    [[nodiscard]] tf::carry_source source() const { return {&file, triangle_of_face}; }
};

/// Reads the job's input, and warns of what is left out.
///
/// \throws failure (of the input) when no triangle is left, or as `check_arrangeable`
[[nodiscard]] usable_input read_usable(job& work);

}  // namespace tools
