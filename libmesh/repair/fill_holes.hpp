#pragma once
/// \file
/// Holes of a surface filled.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

struct filled_holes {
    std::uint64_t holes = 0;
    std::uint64_t edges = 0;  ///< around them
    std::uint64_t faces = 0;  ///< that fill them
};

/// Fills each hole of at most `largest` edges by triangles between its vertices, as `fill`.
///
/// What fills a hole may meet other faces: to cut it is the next step's.
filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest);

}  // namespace treeform::detail::repair
