#pragma once
/// \file
/// Parts of a surface that end somewhere.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// [F] 1 for faces of parts with an edge along which faces run more often one way than the other.
/// Faces with a common edge are of one part.
///
/// \param times [F] how often each face counts, negative where it is turned over; those with 0 are
///              not there, and get 0
/// \cost  O(V + F log d) for at most d faces at a point
/// \same  on any number of threads
[[nodiscard]] std::vector<std::uint8_t> find_unbalanced_parts(std::size_t point_count,
                                                              std::span<const face> faces,
                                                              std::span<const double> times);

}  // namespace treeform::detail::boolean
