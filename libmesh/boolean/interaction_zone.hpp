#pragma once
/// \file
/// The interaction zone: the faces that can matter to each other, of one operand or several.

#include <libmesh/boolean/cut_operand.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// What is cut at once as one mesh: an operand, or several that were joined.
struct bundle {
    const cut_operand* known = nullptr;
    const prepared_mesh* mesh = nullptr;  ///< `known->mesh`
    std::span<const face_pair> pairs{};   ///< of its own faces that meet beyond shared corners
    bool has_pairs = true;                ///< else those of what is near are to be found
    std::uint32_t operand = 0;            ///< that it is; of several, 0
    std::vector<std::uint32_t> operand_of_face{};  ///< [F] where there are several

    [[nodiscard]] mesh_view view() const { return mesh->view(); }
    [[nodiscard]] std::uint32_t operand_of(std::size_t face) const {
        return operand_of_face.empty() ? operand : operand_of_face[face];
    }
    [[nodiscard]] operand_element face_source(std::uint32_t face) const {
        return source(face, &joined_operands::face_source);
    }
    [[nodiscard]] operand_element point_source(std::uint32_t point) const {
        return source(point, &joined_operands::point_source);
    }
    /// The number of a face among all that were given, and how many those were.
    [[nodiscard]] std::uint32_t number_as_given(std::uint32_t face) const {
        const bool all = !known->own || known->joined.number_of_face.empty();
        return all ? face : known->joined.number_of_face[face];
    }
    [[nodiscard]] std::size_t count_as_given() const {
        return known->own ? known->joined.first_face.back() : view().faces.size();
    }

  private:
    [[nodiscard]] operand_element source(std::uint32_t number,
                                         operand_element (joined_operands::*of)(std::uint32_t)
                                             const) const {
        if (!known->own) return {operand, number};
        operand_element found = (known->joined.*of)(number);
        found.operand += operand;
        return found;
    }
};

/// All operands; the second may be empty.
using bundles = std::array<bundle, 2>;

/// Faces near where surfaces meet, with points of their own. Faces and points of both bundles are
/// counted through, those of the first before those of the second.
struct interaction_zone {
    mesh local;                           ///< ascending; equal points are one
    std::uint32_t first_of_b = 0;         ///< local faces from here on are of the second
    std::vector<std::uint32_t> face_of;   ///< [F] face of a bundle
    std::vector<std::uint32_t> point_of;  ///< [V] the lowest point of a bundle that it is
    std::vector<face_pair> pairs;         ///< of local faces that meet beyond shared corners
    std::array<std::vector<std::uint8_t>, 2> is_near;  ///< [F] by the order of each tree
};

/// Near are the faces whose boxes overlap that of a face that meets another one, or are at a point
/// where faces are not one closed fan. So whatever lies in the box of a face that is cut has
/// nothing in common with the box of a face that is not near, and at each point of such a face,
/// faces are one closed fan of which none is cut.
///
/// `once`: skips indexes that pay off only across operations. `all`: every face is near, as is
/// needed by those who ask for cells.
///
/// \cost   that of the faces that meet, and O(V + F / 8) besides
/// \same   on any number of threads
[[nodiscard]] interaction_zone find_interaction_zone(const bundles& operands, bool once,
                                                     bool all = false);

/// [local faces] their numbers among the faces of all operands as they were given.
[[nodiscard]] std::vector<std::uint32_t> numbers_as_given(const bundles& operands,
                                                          const interaction_zone& near);

}  // namespace treeform::detail::boolean
