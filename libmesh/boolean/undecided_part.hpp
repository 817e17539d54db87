#pragma once
/// \file
/// The part of operands that can be on the surface of a result.

#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/boolean/undecided_space.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace treeform::detail::boolean {

/// What of operands that were joined reaches into undecided space: all else is dropped. Lines that
/// tell what winds around a place pass through all of it, though.
class undecided_part {
  public:
    /// None where operands hide too little of each other to halve even one box. How far to look
    /// follows from what a few faces have beside them (`sample_faces`); the result is the same.
    ///
    /// \param joined closed operands; used up where there is a part
    /// \param edges  theirs; used up
    /// \cost  that of `surface_components` and `sample_faces`, then of `undecided_space`
    /// \same  on any number of threads
    [[nodiscard]] static std::unique_ptr<const undecided_part> find(
        joined_operands& joined, operand_edges&& edges, const boolean_expression& expression,
        fill_rule rule);
    /// As far as `limits` say. \param components of `joined.all`
    undecided_part(joined_operands&& joined, surface_components&& components,
                   const partial_expression& at_nowhere, const division_limits& limits);

    [[nodiscard]] const undecided_space& space() const { return space_; }
    /// Of all operands.
    [[nodiscard]] const surface_components& components() const { return components_; }

    /// The faces that reach into undecided space.
    [[nodiscard]] joined_operands faces() const;
    /// How many do not.
    [[nodiscard]] std::size_t left_out() const;

    /// Whether two faces that meet do so in undecided space.
    /// \param mesh of some of its faces
    [[nodiscard]] bool is_undecided(mesh_view mesh, const face_pair& pair) const;

  private:
    joined_operands whole_;
    surface_components components_;
    undecided_space space_;
};

}  // namespace treeform::detail::boolean
