#pragma once
/// \file
/// The relation of two meshes, and how they lie to each other, at the places where they are, or may
/// come to be.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <limits>
#include <optional>

namespace treeform::detail::place {

/// `relation`, without the checks of the operands. Also `cancelled` when the effort is exhausted in
/// one of its searches for pairs of faces.
[[nodiscard]] relation_result relation_of(const shape& a, const shape& b,
                                          const progress_callback& progress = {},
                                          base::effort* effort = nullptr);

/// `measure`, without the checks of the operands.
[[nodiscard]] std::optional<relation_result> measure_of(
    const shape& a, const shape& b, double radius = std::numeric_limits<double>::infinity(),
    const progress_callback& progress = {});

/// The barycentric coordinates of `p` in the triangle `t`, as in `surface_point`.
///
/// \pre coordinates are finite; `p` is on the triangle, up to rounding: otherwise the result is for
///      some other point of the triangle
[[nodiscard]] std::array<double, 3> barycentric_weights(const std::array<point3, 3>& t,
                                                        const point3& p);

}  // namespace treeform::detail::place
