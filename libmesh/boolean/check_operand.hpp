#pragma once
/// \file
/// Whether a mesh can be an operand: whether it is closed.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

namespace treeform::detail::boolean {

/// As `treeform::check_operand`; errors name the function `called`.
[[nodiscard]] certificate check_operand(const char* called, mesh_view mesh,
                                        const progress_callback& progress = {});

}  // namespace treeform::detail::boolean
