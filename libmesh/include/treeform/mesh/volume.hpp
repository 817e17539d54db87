#pragma once
/// \file
/// The volume that a mesh encloses.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

namespace treeform {

/// The volume inside a closed mesh, in cubic units; negative when it is inside out. What it winds
/// around several times counts as often. Of an open mesh, the volume of the cones over its faces
/// from the origin. 0 of an empty one.
///
/// Computed in twice the precision of double and rounded at the end: exact but for a few units of
/// 2^-100 times the sum, over the faces, of the largest product of three coordinates, so that a
/// small part far from the origin has its volume, too. Not finite where such a product is beyond
/// the range of double.
///
/// \pre    every corner is less than `mesh.points.size()`, every coordinate is finite
/// \cost   O(F)
/// \same   on any number of threads
/// \source Dekker, A Floating-Point Technique for Extending the Available Precision, Numer. Math.
///         18 (1971)
[[nodiscard]] TREEFORM_API double signed_volume(mesh_view mesh);

}  // namespace treeform
