#pragma once
/// \file
/// How two meshes lie to each other at the places where they are, or may come to be.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

#include <limits>
#include <optional>

namespace treeform::detail::place {

/// As `measure`, which has checked the operands.
[[nodiscard]] std::optional<mesh_measure> measure_of(
    const shape& a, const shape& b, double radius = std::numeric_limits<double>::infinity(),
    const progress_callback& progress = {});

}  // namespace treeform::detail::place
