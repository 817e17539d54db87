#pragma once
/// \file
/// How many outlines libnest2d, which slicers arrange by, puts on a plate.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace test {

/// A part seen from above: its points.
using flat_points = std::vector<std::array<double, 2>>;

/// Of the parts, each as its convex hull, as PrusaSlicer takes them: those on the first plate of
/// `length` by `length`. None where libnest2d was not found. In C++17, which that needs.
[[nodiscard]] std::optional<std::size_t> nest_outlines(const std::vector<flat_points>& parts,
                                                       double length, double spacing);

}  // namespace test
