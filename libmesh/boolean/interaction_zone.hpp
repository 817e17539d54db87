#pragma once
/// \file
/// The interaction zone: the faces of one or several operands that can affect each other.

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

/// An operand, or several joined operands, cut as one mesh.
struct bundle {
    const cut_operand* known = nullptr;
    const prepared_mesh* mesh = nullptr;  ///< `known->mesh`
    std::span<const face_pair> pairs{};  ///< pairs of its own faces that meet beyond shared corners
    bool has_pairs = true;               ///< otherwise, the pairs of near faces have to be found
    std::uint32_t operand = 0;           ///< number of the operand; 0 for several
    /// [F] operand of each face, if there are several
    std::vector<std::uint32_t> operand_of_face{};

    [[nodiscard]] mesh_view view() const { return mesh->indexed_view(); }
    [[nodiscard]] std::uint32_t operand_of(std::size_t face) const {
        return operand_of_face.empty() ? operand : operand_of_face[face];
    }
    [[nodiscard]] operand_element face_source(std::uint32_t face) const {
        return source(face, &joined_operands::face_source);
    }
    [[nodiscard]] operand_element point_source(std::uint32_t point) const {
        return source(point, &joined_operands::point_source);
    }
    /// The number of a face among the faces as they were given, and the count of these.
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

/// All operands, in two bundles; the second may be empty.
using bundles = std::array<bundle, 2>;

/// The near faces, that is, those near intersections, as a mesh with its own points. Faces and
/// points of both bundles are numbered consecutively, the first bundle before the second.
struct interaction_zone {
    mesh local;                           ///< faces in ascending order; equal points joined
    std::uint32_t first_of_b = 0;         ///< local faces from here on are of the second bundle
    std::vector<std::uint32_t> face_of;   ///< [F] face in its bundle
    std::vector<std::uint32_t> point_of;  ///< [V] the lowest point of a bundle equal to it
    std::vector<face_pair> pairs;         ///< local faces that meet beyond shared corners
    std::array<std::vector<std::uint8_t>, 2> is_near;  ///< [F] in the order of each tree
};

/// A face is near if its box overlaps that of a face that meets another face, or if it is at a
/// point where the faces are not one closed fan. So the box of a face that is cut does not overlap
/// the box of a face that is not near, and at each point of a face that is not near, the faces are
/// one closed fan and none of them is cut.
///
/// `single_use`: skips indexes that pay off only across operations. `all`: every face counts as
/// near, which is required for cells.
///
/// \cost   that of finding the faces that meet, plus O(V + F / 8)
/// \same   on any number of threads
[[nodiscard]] interaction_zone find_interaction_zone(const bundles& operands, bool single_use,
                                                     bool all = false);

/// [local faces] the number of each among the faces of all operands as they were given.
[[nodiscard]] std::vector<std::uint32_t> numbers_as_given(const bundles& operands,
                                                          const interaction_zone& near);

}  // namespace treeform::detail::boolean
