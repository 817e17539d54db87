#pragma once
/// \file
/// What fills the gaps between operands of a union.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {

/// Throws unless an expression is a union of all its operands.
/// \throws std::invalid_argument naming the `function` called
void require_union(const char* function, const boolean_expression& expression);

/// Faces of different operands that lie over each other, and a prism on each of them, outward, to
/// be further operands: what two such prisms have in common is the gap between their faces.
///
/// A face is a prism's base as it is; its top is rounded. It is a little higher than gaps are wide,
/// so that it gets across all the same. Prisms side by side on faces of one operand that lean by at
/// most 45 degrees share their walls; else walls are upright. Which faces are near is decided in
/// doubles, what the union is, exactly.
class filled_gaps {
  public:
    /// Two faces lie over each other where they lean by at most 45 degrees, each looks at the
    /// other, and a part of one is straight above a part of the other, by at most `width`. Faces
    /// that meet may be such. Faces without an area are none.
    ///
    /// \pre    every corner is a point, and finite
    /// \cost   O(F log F + P) time for P pairs of faces whose boxes are that near, 200 bytes a face
    /// \same   on any number of threads
    filled_gaps(std::span<const mesh_view> operands, double width);

    [[nodiscard]] bool empty() const { return bases_.empty(); }
    /// Faces that have a prism.
    [[nodiscard]] std::size_t size() const { return bases_.size(); }

    /// The operands, then the prisms. Those refer to this.
    [[nodiscard]] std::vector<mesh_view> operands() const;
    /// What is in an operand, or in both prisms of two faces.
    [[nodiscard]] boolean_expression expression() const;
    /// The groups of faces, where there are any, with those of prisms as those of their bases.
    /// \throws std::invalid_argument for another number of groups than of faces
    [[nodiscard]] std::vector<std::uint32_t> face_groups(
        std::span<const std::uint32_t> given) const;
    /// Puts faces of the operands in place of those of prisms.
    void name_sources(boolean_result& result) const;

  private:
    void add_prism(const std::array<point3, 3>& base, const std::array<point3, 3>& top);

    std::vector<mesh_view> given_;
    std::vector<operand_element> bases_{};  ///< [prisms]
    std::vector<point3> points_{};          ///< [6 prisms] of the base, then above these
    std::vector<face> faces_{};             ///< [8 prisms] in numbers of a prism's own
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_{};  ///< of prisms
};

}  // namespace treeform::detail::boolean
