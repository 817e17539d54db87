#pragma once
/// \file
/// Regions of space and the patches between them, and an expression that is taken from one to the
/// next.

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
    region_graph(const region_graph&) = delete;
    region_graph& operator=(const region_graph&) = delete;

    [[nodiscard]] std::size_t size() const { return region_.count(); }
    /// The regions on both sides of patches.
    [[nodiscard]] const arrange::region_patches& patches() const { return around_; }

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
    void cross(std::uint32_t patch, std::uint32_t from, partial_expression& state) const;

    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
    const arrange::surface_patches& patches_;
    arrange::numbered_sets region_;
    arrange::region_patches around_;
};

}  // namespace treeform::detail::boolean
