#pragma once
/// \file
/// Which faces bound what an expression makes of operands, of those near cuts and of all others.

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

/// What becomes of a face that is not near.
enum class disposition : std::uint8_t { cut, dropped, kept, turned };

struct chosen_surface {
    round::solid_faces near;  ///< of the arrangement of what is near
    /// Of all faces of both bundles, counted through; `cut` are those that are near.
    buffer<disposition> dispositions{};
};

/// How often operands wind around both sides of all faces: patches between cuts are alike, and so
/// are sets of faces that are not near. A line from one face of each group of patches that hang
/// together, and of each set, tells, exactly; from there on, crossing a patch does.
class near_labels {
  public:
    /// \param cut the arrangement of `near.local`
    /// \param far of the meshes of both bundles
    /// \pre   all operands are closed; what is referred to outlives this
    /// \cost  O(F' log F') for the F' faces of the arrangement, and O(log F) a line
    /// \same  on any number of threads
    /// \param part  that the operands are, or null where they are whole
    near_labels(const bundles& operands, const interaction_zone& near, const mesh_arrangement& cut,
                std::array<far_faces, 2> far, const undecided_part* part = nullptr);

    /// \cost  a change of the expression for each patch, and O(F)
    [[nodiscard]] chosen_surface choose(const boolean_expression& expression, fill_rule rule) const;

    /// The volumes of what two operands are, and of both together, from the points as approximated.
    ///
    /// \cost what crosses each patch, twice, and O(F)
    [[nodiscard]] operand_volumes volumes(fill_rule rule) const;

  private:
    /// One side of a face that is not near.
    struct far_side {
        bool in_front = false;
        std::uint32_t operand = 0;  ///< whose face it is
        std::vector<operand_winding> windings{};
    };
    /// 1 where an expression holds, else 0.
    struct insides {
        std::vector<std::uint8_t> regions;
        /// In front of the faces of each set, and behind them.
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
