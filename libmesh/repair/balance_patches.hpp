#pragma once
/// \file
/// Patches that agree at edges of more than two faces.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

/// Turns patches while that makes faces run more nearly as often one way as the other along the
/// edges of more than two faces; returns how many faces.
///
/// What is made less is the sum over these edges of their length times the surplus of one way. The
/// patch that helps most is turned first, of several the lowest. A patch at whose edges nothing is
/// wrong stays.
///
/// \pre  faces agree within patches (`make_faces_agree`)
/// \cost O(V + F log F), and a look at the neighbors of each patch that is turned
/// \same on any number of threads
std::uint64_t balance_patches(working_mesh& mesh);

}  // namespace treeform::detail::repair
