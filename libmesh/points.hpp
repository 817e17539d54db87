#pragma once
/// \file
/// Point sets: an array of `point3`, and the view of one that algorithms take.

#include <libmesh/exact/point.hpp>

#include <span>

namespace tf {

using points_view = std::span<const point3>;  ///< [V]

}  // namespace tf
