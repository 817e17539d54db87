#pragma once
/// \file
/// The closed pieces of operands, and how often each winds around points.

#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// How often an operand winds around a point.
struct operand_winding {
    std::uint32_t operand = 0;
    std::int64_t winding = 0;
};

/// The winding numbers that a surface may have, by place.
struct component_windings {
    component_windings() = default;
    explicit component_windings(const winding_range& range) : all(range), usual(range) {}

    winding_range all = winding_range::unknown();
    winding_range usual = winding_range::unknown();  ///< outside of the boxes
    std::vector<aabb<double, 3>> unusual{};
};

/// The sign of the signed volume of a closed surface, or 0 where rounding may have decided it.
[[nodiscard]] int sign_of_volume(mesh_view closed);

/// A component is what edges link of an operand; pieces of an operand that are closed only together
/// are one. Each has a tree.
class surface_components {
  public:
    /// \param edges of the operands, all of which are closed
    /// \pre   `joined` and `operand_of_face` outlive this
    /// \cost  O(F log F), 40 bytes a face; for components of operands that have several, whose
    ///        faces are not all seen from one point inside, a search for self-intersections, and
    ///        where there are some, an arrangement
    /// \same  on any number of threads
    surface_components(mesh_view joined, std::span<const std::uint32_t> operand_of_face,
                       const operand_edges& edges);

    [[nodiscard]] std::size_t size() const { return components_.size(); }
    [[nodiscard]] mesh_view mesh() const { return mesh_; }
    [[nodiscard]] std::uint32_t operand(std::size_t c) const { return components_[c].operand; }
    [[nodiscard]] const aabb<double, 3>& box(std::size_t c) const { return components_[c].box; }
    /// Over its faces: `ids()` are places in `faces`.
    [[nodiscard]] const tree<3>& tree_of(std::size_t c) const { return components_[c].index; }
    /// Ascending.
    [[nodiscard]] std::span<const std::uint32_t> faces(std::size_t c) const {
        return {faces_.data() + components_[c].begin, components_[c].end - components_[c].begin};
    }

    /// The winding numbers that a component may have around points. Unknown for the only one of an
    /// operand, and where too many of the component's faces meet each other.
    [[nodiscard]] const winding_range& range(std::size_t c) const {
        return components_[c].windings.all;
    }
    /// Those that it may have outside of some boxes, which are around the places where it winds
    /// otherwise: small ones, where it meets itself.
    [[nodiscard]] const winding_range& usual_range(std::size_t c) const {
        return components_[c].windings.usual;
    }
    [[nodiscard]] std::span<const aabb<double, 3>> unusual_boxes(std::size_t c) const {
        return components_[c].windings.unusual;
    }

    /// Calls `visit(c)` for the components whose boxes overlap another one.
    template <class Visit>
    void visit_overlapping(const aabb<double, 3>& box, const Visit& visit) const {
        search(boxes_, box, visit);
    }
    /// How often component c winds around q, exactly. \pre q is not on it
    [[nodiscard]] std::int64_t winding_around(std::size_t c, const point3& q) const;
    /// The same of all components but c together.
    [[nodiscard]] std::int64_t winding_of_others(std::size_t c, const point3& q) const;

    /// The sign of the signed volume of component c, or 0 where rounding may have decided it.
    [[nodiscard]] int sign_of_volume(std::size_t c) const;

    /// The box around all of them.
    [[nodiscard]] const aabb<double, 3>& box() const { return box_; }

    /// How often operands wind around all that is right beside a face of an arrangement, on one of
    /// its sides, where a line passes through it, exactly; those that wind around it, ascending.
    ///
    /// \param line  through the face
    /// \param ahead whether that is ahead of the face, or behind it; the line is followed that way
    [[nodiscard]] std::vector<operand_winding> windings_beside(const arrange::corner_line& line,
                                                               bool ahead) const;

  private:
    struct component {
        std::uint32_t operand = 0;
        std::size_t begin = 0, end = 0;  ///< of its faces
        bool is_manifold = false;
        aabb<double, 3> box{};
        component_windings windings{};
        tree<3> index{};
    };

    void collect(std::span<const std::uint32_t> operand_of_face, const operand_edges& edges);
    void prepare(component& c, bool with_range) const;
    [[nodiscard]] component_windings windings_of(const component& c) const;
    [[nodiscard]] triangle3 corners(std::uint32_t f) const;

    mesh_view mesh_;
    std::vector<std::uint32_t> faces_{};  ///< component by component
    std::vector<component> components_{};
    tree<3> boxes_{};  ///< of components
    aabb<double, 3> box_{};
};

}  // namespace treeform::detail::boolean
