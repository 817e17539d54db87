#pragma once
/// \file
/// Finds the open parts of a surface.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// [F] 1 for faces of parts with an edge whose signed face count is not zero. Faces with a common
/// edge are in one part.
///
/// \param times [F] how often each face counts, negative if flipped; faces with 0 are ignored, and
///              get 0
/// \cost  O(V + F log d) for at most d faces at a point
/// \same  on any number of threads
[[nodiscard]] std::vector<std::uint8_t> find_unbalanced_parts(std::size_t point_count,
                                                              std::span<const face> faces,
                                                              std::span<const double> times);

}  // namespace treeform::detail::boolean
