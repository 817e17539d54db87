#pragma once
/// \file
/// What keeps a mesh from being computed with.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <vector>

namespace treeform {

/// Lists of numbers, each ascending. A face is in one list at most.
struct mesh_defects {
    std::vector<std::uint32_t> nonfinite_points;    ///< with a NaN or infinite coordinate
    std::vector<std::uint32_t> nonfinite_faces;     ///< with such a corner
    std::vector<std::uint32_t> degenerate_faces;    ///< finite, with exactly collinear corners
    std::vector<std::uint32_t> out_of_range_faces;  ///< with a corner that is no point
    friend bool operator==(const mesh_defects&, const mesh_defects&) = default;
};

/// Finds the points and faces that algorithms refuse or treat apart.
///
/// Collinear is exact: a face with a repeated corner or with equal corners is, a sliver of any
/// thinness is not. A corner that is no point is looked at first, then whether all are finite.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points or faces
/// \cost   O(V + F) time, memory for what is found
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_defects find_defects(mesh_view mesh);

}  // namespace treeform
