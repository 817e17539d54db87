#pragma once
/// \file
/// Checks the faces passed to public functions.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <span>

namespace treeform::detail::base {

/// \throws std::invalid_argument naming `function` and the lowest face with a corner that is not
///         less than `point_count`, or when there are more faces than 32 bits can number
/// \cost   O(F), in parallel
void check_faces(const char* function, std::size_t point_count, std::span<const face> faces);

/// \throws std::invalid_argument naming `function` and the lowest face with a corner that is not
///         finite
/// \pre    every corner is a point
/// \cost   O(F), in parallel
void check_finite_faces(const char* function, mesh_view mesh);

/// \throws std::invalid_argument naming `function` if the mesh has points but no faces
void refuse_cloud(const char* function, mesh_view mesh);

}  // namespace treeform::detail::base
