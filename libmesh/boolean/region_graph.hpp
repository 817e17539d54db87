#pragma once
/// \file
/// The graph of regions of space, linked by patches, and the propagation of an expression through
/// it.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/arrange/region_patches.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A region, and the nonzero winding numbers of operands around it.
struct region_seed {
    std::uint32_t region = 0;
    std::vector<operand_winding> windings{};
};

class region_graph {
  public:
    /// \param regions the regions on both sides of each patch, numbered as by
    ///        `arrange::patch_regions`
    /// \pre   the arguments outlive this
    region_graph(const mesh_arrangement& cut, std::span<const std::uint32_t> operand_of_face,
                 const arrange::surface_patches& patches, arrange::numbered_sets regions);
    region_graph(const region_graph&) = delete;
    region_graph& operator=(const region_graph&) = delete;

    [[nodiscard]] std::size_t size() const { return region_.count(); }
    /// The regions on both sides of each patch.
    [[nodiscard]] const arrange::region_patches& patches() const { return around_; }

    /// [R] the lowest region linked with each by patches.
    [[nodiscard]] buffer<std::uint32_t> groups() const;

    /// Traverses the regions linked with the seed, across patches and back, and writes whether each
    /// is inside. Memory does not grow with the number of operands.
    ///
    /// \param state  with all winding numbers 0; restored at the end
    /// \param inside [R] of regions linked with the seed
    /// \cost  O(regions + patches) changes of the expression
    void spread(const region_seed& from, partial_expression& state,
                std::vector<std::uint8_t>& inside) const;

  private:
    void cross(std::uint32_t patch, std::uint32_t from, partial_expression& state) const;

    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
    const arrange::surface_patches& patches_;
    arrange::numbered_sets region_;
    arrange::region_patches around_;
};

}  // namespace treeform::detail::boolean
