#pragma once
/// \file
/// The lines along which faces meet, as segments to draw.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

struct curve_segment {
    std::array<point3, 2> ends{};  ///< equal when the faces meet in a point
    std::uint32_t pair = 0;        ///< index into the pairs given
    friend bool operator==(const curve_segment&, const curve_segment&) = default;
};

/// What the two faces of each pair have in common, as segments: one for a crossing, the rim for
/// faces that overlap (3 to 6), a segment without length for a single point. In the order of
/// `pairs`.
///
/// That there is a segment is exact; where it ends is rounded (`approximate_point`), and the
/// coordinates are finite.
///
/// \pre  faces of `pairs` and their corners are in range, every coordinate is finite
/// \cost O(pairs)
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::vector<curve_segment> intersection_curves(
    mesh_view mesh, std::span<const face_pair> pairs);

}  // namespace treeform
