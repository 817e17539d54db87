#pragma once
/// \file
/// Decides which faces, near cuts and elsewhere, bound the result of an expression.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/boolean/far_faces.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/region_graph.hpp>
#include <libmesh/boolean/undecided_part.hpp>
#include <libmesh/boolean/undecided_places.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace treeform::detail::boolean {

/// The treatment of a face that is not near.
enum class disposition : std::uint8_t { cut, dropped, kept, turned };

struct chosen_surface {
    round::solid_faces near;  ///< faces of the arrangement of the interaction zone
    /// For all faces of both bundles, numbered consecutively; `cut` for near faces.
    buffer<disposition> dispositions{};
};

/// The winding numbers of operands on both sides of all faces. They are constant on patches between
/// cuts, and on sets of faces that are not near. They are computed exactly, by a ray from one face
/// of each connected group of patches, and of each set; crossing a patch changes them by its faces.
class near_labels {
  public:
    /// \param cut the arrangement of `near.local`
    /// \param far the far faces of both bundles
    /// \pre   all operands are closed; the arguments outlive this
    /// \cost  O(F' log F') for the F' faces of the arrangement, and O(log F) for each ray
    /// \same  on any number of threads
    /// \param part  the part of the operands that matters; null: all
    near_labels(const bundles& operands, const interaction_zone& near, const mesh_arrangement& cut,
                std::array<far_faces, 2> far, const undecided_part* part = nullptr);

    /// \cost  a change of the expression for each patch, and O(F)
    [[nodiscard]] chosen_surface choose(const boolean_expression& expression, fill_rule rule) const;

    /// The volumes of two operands, their union and intersection, from the approximate points.
    ///
    /// \cost two changes of the expression for each patch, and O(F)
    [[nodiscard]] operand_volumes volumes(fill_rule rule) const;

  private:
    /// One side of a face that is not near.
    struct far_side {
        bool in_front = false;
        std::uint32_t operand = 0;  ///< whose face it is
        std::vector<operand_winding> windings{};
    };
    /// 1 if the expression is true, else 0.
    struct insides {
        std::vector<std::uint8_t> regions;
        /// For each set: in front of its faces, and behind them.
        std::array<std::vector<std::array<std::uint8_t, 2>>, 2> sets;
    };
    [[nodiscard]] insides insides_of(const boolean_expression& expression, fill_rule rule) const;

    const bundles& operands_;
    const mesh_arrangement& cut_;
    std::vector<std::uint32_t> operand_of_face_;  ///< of `near.local`
    undecided_places places_;
    arrange::surface_patches patches_;
    region_graph regions_;
    std::vector<std::uint8_t> is_hidden_;  ///< [patch]
    std::vector<region_seed> seeds_{};     ///< one for each group of regions
    std::array<far_faces, 2> far_;
    std::array<std::vector<far_side>, 2> sides_{};  ///< of each set
};

}  // namespace treeform::detail::boolean
