#pragma once
/// \file
/// The closed components of operands, and their winding numbers.

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

/// The winding number of an operand.
struct operand_winding {
    std::uint32_t operand = 0;
    std::int64_t winding = 0;
};

/// Ranges of the winding numbers of a surface.
struct component_windings {
    component_windings() = default;
    explicit component_windings(const winding_range& range) : all(range), usual(range) {}

    winding_range all = winding_range::unknown();
    winding_range usual = winding_range::unknown();  ///< range outside of the boxes `unusual`
    std::vector<aabb<double, 3>> unusual{};
};

/// The sign of the signed volume of a closed surface; 0 if rounding might affect it.
[[nodiscard]] int sign_of_volume(mesh_view closed);

/// The components of all operands. A component is a set of faces of one operand linked by edges;
/// pieces of an operand that are only closed together form one component. Each has a tree.
class surface_components {
  public:
    /// \param edges edges of the operands, all of which are closed
    /// \pre   `joined` and `operand_of_face` outlive this
    /// \cost  O(F log F), 40 bytes a face; for each component that is not star-shaped, of operands
    ///        with several components, also a search for self-intersections, and an arrangement if
    ///        there are any
    /// \same  on any number of threads
    surface_components(mesh_view joined, std::span<const std::uint32_t> operand_of_face,
                       const operand_edges& edges);

    [[nodiscard]] std::size_t size() const { return components_.size(); }
    [[nodiscard]] mesh_view mesh() const { return mesh_; }
    [[nodiscard]] std::uint32_t operand(std::size_t c) const { return components_[c].operand; }
    [[nodiscard]] const aabb<double, 3>& box(std::size_t c) const { return components_[c].box; }
    /// The tree over its faces; `ids()` are positions in `faces(c)`.
    [[nodiscard]] const tree<3>& tree_of(std::size_t c) const { return components_[c].index; }
    /// The faces of a component, ascending.
    [[nodiscard]] std::span<const std::uint32_t> faces(std::size_t c) const {
        return {faces_.data() + components_[c].begin, components_[c].end - components_[c].begin};
    }

    /// The range of winding numbers of a component. Unknown if it is the only component of its
    /// operand, or if too many of its faces meet each other.
    [[nodiscard]] const winding_range& range(std::size_t c) const {
        return components_[c].windings.all;
    }
    /// The range outside of `unusual_boxes`: small boxes around self-intersections, in which its
    /// winding number may be different.
    [[nodiscard]] const winding_range& usual_range(std::size_t c) const {
        return components_[c].windings.usual;
    }
    [[nodiscard]] std::span<const aabb<double, 3>> unusual_boxes(std::size_t c) const {
        return components_[c].windings.unusual;
    }

    /// Calls `visit(c)` for the components whose boxes overlap `box`.
    template <class Visit>
    void visit_overlapping(const aabb<double, 3>& box, const Visit& visit) const {
        search(boxes_, box, visit);
    }
    /// The winding number of component c around q, exact. \pre q is not on it
    [[nodiscard]] std::int64_t winding_around(std::size_t c, const point3& q) const;
    /// The winding number of all components except c together.
    [[nodiscard]] std::int64_t winding_of_others(std::size_t c, const point3& q) const;

    /// The sign of the signed volume of component c; 0 if rounding might affect it.
    [[nodiscard]] int sign_of_volume(std::size_t c) const;

    /// The box around all components.
    [[nodiscard]] const aabb<double, 3>& box() const { return box_; }

    /// The nonzero winding numbers of operands just beside a face of an arrangement, where a line
    /// passes through it, on one side; exact, ascending by operand.
    ///
    /// \param line  through the face
    /// \param ahead the side along the line: beyond the face, or before it; the line is followed in
    ///        that direction
    [[nodiscard]] std::vector<operand_winding> windings_beside(const arrange::corner_line& line,
                                                               bool ahead) const;

  private:
    struct component {
        std::uint32_t operand = 0;
        std::size_t begin = 0, end = 0;  ///< range of its faces in `faces_`
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
    tree<3> boxes_{};  ///< tree over the boxes of components
    aabb<double, 3> box_{};
};

}  // namespace treeform::detail::boolean
