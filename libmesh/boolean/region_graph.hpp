#pragma once
/// \file
/// Regions of space and the patches between them, and an expression that is taken from one to the
/// next.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A region, and how often operands wind around it: those that do.
struct region_seed {
    std::uint32_t region = 0;
    std::vector<operand_winding> windings{};
};

class region_graph {
  public:
    /// \param regions those on both sides of each patch, as `arrange::patch_regions` numbers them
    /// \pre   what is referred to outlives this
    region_graph(const mesh_arrangement& cut, std::span<const std::uint32_t> operand_of_face,
                 const arrange::surface_patches& patches, arrange::numbered_sets regions);

    [[nodiscard]] std::size_t size() const { return region_.count(); }
    [[nodiscard]] std::uint32_t front(std::uint32_t patch) const {
        return region_[2 * std::size_t{patch} + 1];
    }
    [[nodiscard]] std::uint32_t behind(std::uint32_t patch) const {
        return region_[2 * std::size_t{patch} + 2];
    }

    /// [R] the lowest of the regions that patches link with each.
    [[nodiscard]] buffer<std::uint32_t> groups() const;

    /// Goes from region to region across patches, and back the same way, and writes down for each
    /// whether it is inside. Memory does not grow with the number of operands.
    ///
    /// \param state  where nothing winds around anything; is given back so
    /// \param inside [R] of regions linked with the seed
    /// \cost  O(regions + patches) changes of the expression
    void spread(const region_seed& from, partial_expression& state,
                std::vector<std::uint8_t>& inside) const;

  private:
    [[nodiscard]] std::uint32_t beyond(std::uint32_t patch, std::uint32_t region) const {
        return front(patch) == region ? behind(patch) : front(patch);
    }
    [[nodiscard]] std::span<const std::uint32_t> patches_at(std::uint32_t region) const {
        return {patches_at_.data() + begin_[region], begin_[region + 1] - begin_[region]};
    }
    void cross(std::uint32_t patch, std::uint32_t from, partial_expression& state) const;

    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
    const arrange::surface_patches& patches_;
    arrange::numbered_sets region_;
    std::vector<std::size_t> begin_;         ///< where the patches of each region begin
    std::vector<std::uint32_t> patches_at_;  ///< region by region
};

}  // namespace treeform::detail::boolean
