#pragma once
/// \file
/// Approximate coordinates of a contact of two triangles, for display and reports.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

namespace treeform {

/// Coordinates of the contact `c` of `a` and `b`, rounded.
///
/// A corner is returned unchanged (that of `a` if both features are corners). Any other point is
/// computed in double: with an error of a few units in the last place of the edge length, or more
/// if edge and plane, or the two edges, are nearly parallel. The result is finite and inside the
/// box of each feature named, hence inside the boxes of both triangles. Do not use it for
/// decisions: two contacts may round to the same point, and the point need not be on either
/// triangle.
///
/// \pre every coordinate is finite; `c` is an end of the result of `intersect(a, b)`
[[nodiscard]] TREEFORM_API point3 approximate_point(const triangle3& a, const triangle3& b,
                                                    feature_pair c);

}  // namespace treeform
