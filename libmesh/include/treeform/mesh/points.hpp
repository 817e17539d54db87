#pragma once
/// \file
/// Point sets: an array of `point3`, and the view of one that algorithms take.

#include <treeform/mesh/point.hpp>

#include <span>

namespace treeform {

using points_view = std::span<const point3>;  ///< [V]

}  // namespace treeform
