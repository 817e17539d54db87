#pragma once
/// \file
/// What is wrong with a surface once it is in a file: found by reading it as a reader would.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>

namespace treeform::bench {

struct surface_defects {
    std::size_t intersections = 0;  ///< pairs of faces that meet where they should not
    std::size_t degenerate = 0;     ///< faces without area
    std::size_t open_edges = 0;     ///< edges along which faces do not run as often one way
    std::size_t crowded_edges = 0;  ///< edges of more than two faces
};

/// `mesh` with each coordinate as a float32 holds it, or as it is.
[[nodiscard]] mesh as_written(mesh mesh, bool in_float);

/// Of a surface as written, points with equal coordinates being one. Decided exactly.
[[nodiscard]] surface_defects defects_of(const mesh& written);

}  // namespace treeform::bench
