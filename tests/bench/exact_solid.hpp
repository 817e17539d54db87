#pragma once
/// \file
/// What solids and set operations on them are before anything is rounded, and how far from it a
/// surface is that was rounded.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <gmpxx.h>

#include <optional>
#include <span>

namespace treeform::bench {

struct exact_solid {
    mpq_class volume;  ///< of rational faces, added up in 1024 bits
    mesh surface;      ///< its faces, with each corner rounded to the nearest doubles
};

/// By treeform's arrangement, which is cut and chosen from before anything is rounded; none where
/// an operand bounds no solid.
[[nodiscard]] std::optional<exact_solid> exact_solid_of(std::span<const mesh> operands,
                                                        const boolean_expression& expression);

/// How far a corner of one surface is from the other surface at most, over the diagonal of the box
/// of `exact`: the largest such distance, with room for what rounding does to it and to `exact`.
/// 1 where only one of them has faces, 0 where neither has.
[[nodiscard]] double corner_distance(const mesh& found, const mesh& exact);

}  // namespace treeform::bench
