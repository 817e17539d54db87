#pragma once
/// \file
/// Fills the gaps between the operands of a union.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {

/// Checks that an expression is a union of all its operands.
/// \throws std::invalid_argument naming the `function` called
void require_union(const char* function, const boolean_expression& expression);

/// Pairs of faces of different operands that face each other across a gap, and an outward prism on
/// each of these faces as an additional operand: the intersection of the two prisms of a pair is
/// the gap between its faces.
///
/// The base of a prism is the face, unchanged; its top is rounded. Prisms are slightly higher than
/// the gap width, so that they reach across despite rounding. Adjacent prisms on faces of one
/// operand with an angle of at most 45 degrees share their walls; other walls are perpendicular.
/// The pairs are found in doubles, the union is exact.
class filled_gaps {
  public:
    /// Two faces form a pair if they face each other at an angle of at most 45 degrees, and a part
    /// of one is within `width` of a part of the other along a normal. Faces that meet may form a
    /// pair; degenerate faces do not.
    ///
    /// \pre    every corner is a point, and finite
    /// \cost   O(F log F + P) time for P pairs of faces whose boxes are within `width`, 200 bytes a
    ///         face
    /// \same   on any number of threads
    filled_gaps(std::span<const mesh_view> operands, double width);

    [[nodiscard]] bool empty() const { return bases_.empty(); }
    /// Number of faces with a prism.
    [[nodiscard]] std::size_t size() const { return bases_.size(); }

    /// The operands, then the prisms, which refer to this object.
    [[nodiscard]] std::vector<mesh_view> operands() const;
    /// The union of the operands and, for each pair, the intersection of its two prisms.
    [[nodiscard]] boolean_expression expression() const;
    /// The groups of all faces; faces of prisms have the groups of their bases. Empty if `given` is
    /// empty.
    /// \throws std::invalid_argument for another number of groups than of faces
    [[nodiscard]] std::vector<std::uint32_t> face_groups(
        std::span<const std::uint32_t> given) const;
    /// Replaces faces of prisms in the sources by faces of the operands.
    void name_sources(boolean_result& result) const;

  private:
    void add_prism(const std::array<point3, 3>& base, const std::array<point3, 3>& top);

    std::vector<mesh_view> given_;
    std::vector<operand_element> bases_{};  ///< [prisms]
    std::vector<point3> points_{};          ///< [6 prisms] corners of each base, then of each top
    std::vector<face> faces_{};             ///< [8 prisms] with point numbers within each prism
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_{};  ///< of prisms
};

}  // namespace treeform::detail::boolean
