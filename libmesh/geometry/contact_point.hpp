#pragma once
/// \file
/// Where a named contact of two triangles is, for pictures and reports.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/detail/export.hpp>

namespace treeform {

/// Coordinates of the contact `c` of `a` and `b`, rounded.
///
/// A corner comes out bit for bit (that of `a` where both are corners). Any other point is computed
/// in double: to a few units in the last place of the edge's length where edge and plane, or
/// edge and edge, meet at a fair angle; less well when they are nearly parallel. Always finite, and
/// always inside the box of each feature named, hence inside the boxes of both triangles. Decides
/// nothing: two contacts may round to one point, and the point need not lie on either triangle.
///
/// \pre every coordinate is finite and `c` is an end that `intersect(a, b)` names
[[nodiscard]] TREEFORM_API point3 approximate_point(const triangle3& a, const triangle3& b,
                                                    contact c);

}  // namespace treeform
