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

/// The part of joined operands that reaches into undecided space; all other faces are dropped. Rays
/// for winding numbers still use all faces.
class undecided_part {
  public:
    /// Null if operands hide too little of each other to halve even one box. The limits of the
    /// division are chosen from a few sample faces (`sample_faces`); they do not affect results.
    ///
    /// \param joined closed operands; consumed if a part is returned
    /// \param edges  their edges; consumed
    /// \cost  that of `surface_components` and `sample_faces`, then of `undecided_space`
    /// \same  on any number of threads
    [[nodiscard]] static std::unique_ptr<const undecided_part> find(
        joined_operands& joined, operand_edges&& edges, const boolean_expression& expression,
        fill_rule rule);
    /// Divides space within `limits`. \param components the components of `joined.all`
    undecided_part(joined_operands&& joined, surface_components&& components,
                   const partial_expression& at_nowhere, const division_limits& limits);

    [[nodiscard]] const undecided_space& space() const { return space_; }
    /// The components of all operands.
    [[nodiscard]] const surface_components& components() const { return components_; }

    /// The faces that reach into undecided space.
    [[nodiscard]] joined_operands faces() const;
    /// The number of faces that do not.
    [[nodiscard]] std::size_t left_out() const;

    /// Whether two faces that meet may do so in undecided space.
    /// \param mesh some of the faces of this
    [[nodiscard]] bool is_undecided(mesh_view mesh, const face_pair& pair) const;

  private:
    joined_operands whole_;
    surface_components components_;
    undecided_space space_;
};

}  // namespace treeform::detail::boolean
