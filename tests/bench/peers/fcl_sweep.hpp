#pragma once
/// \file
/// The first contact of triangles in straight motion by FCL's continuous tests.

#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::bench {

/// The least time in [0, 1] that `Intersect::intersect_VF` and `intersect_EE` give for the corners
/// and edges of `a`, which moves by `d` in that time, against `b`.
[[nodiscard]] std::optional<double> fcl_first_contact(const triangle3& a, const triangle3& b,
                                                      const point3& d);

}  // namespace treeform::bench
