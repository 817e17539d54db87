#pragma once
/// \file
/// Checks pairs of faces passed by callers.

#include <treeform/mesh/self_intersections.hpp>

#include <span>

namespace treeform::detail::intersect {

/// \throws std::invalid_argument, naming `function`, for the first pair with a face out of range,
///         or one with a corner out of range or not finite, or, with `need_area`, without area,
///         unless the kind of the pair says so
void check_pairs(const char* function, mesh_view mesh, std::span<const face_pair> pairs,
                 bool need_area);

}  // namespace treeform::detail::intersect
