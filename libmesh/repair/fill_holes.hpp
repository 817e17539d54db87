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

/// Fills each hole of at most `largest` edges: `triangulate_rim`, or else a cone over the rim. Large
/// holes of smooth surfaces are refined and made fair.
/// Afterwards, faces run as often one way as the other along each edge of every rim filled.
///
/// What fills a hole may meet other faces: to cut it is the next step's.
filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest);

}  // namespace treeform::detail::repair
