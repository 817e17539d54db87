#pragma once
/// \file
/// The relation and distance of two placed meshes.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

#include <limits>
#include <optional>

namespace treeform::detail::place {

/// `measure`, without the checks of the operands.
[[nodiscard]] std::optional<mesh_measure> measure_of(
    const shape& a, const shape& b, double radius = std::numeric_limits<double>::infinity(),
    const progress_callback& progress = {});

}  // namespace treeform::detail::place
