#pragma once
/// \file
/// What meshes must be for faces to be cut along each other.

#include "tools/shell/exit_status.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tools {

/// \throws failure (of the input) naming a point in use with a coordinate beyond 2^1000
inline void check_arrangeable(const std::string& name, const tf::mesh& mesh) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f])
            for (std::size_t k = 0; k < 3; ++k)
                if (std::abs(mesh.points[corner][k]) > 0x1p1000)
                    throw failure(bad_input, "too-large",
                                  name + ": triangle " + std::to_string(f) +
                                      " has a coordinate beyond 2^1000 (about 1e301), which is too "
                                      "large; scale the mesh down");
}

}  // namespace tools
