#pragma once
/// \file
/// The regions on both sides of patches, and the patches around regions.

#include <libmesh/arrange/numbered_sets.hpp>
#include <libmesh/arrange/patches.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// Regions are those of `patch_regions`: of element 0, the unbounded region, then of the front and
/// the back of each patch.
class region_patches {
  public:
    /// \pre `regions` outlives this
    /// \cost O(regions + patches)
    region_patches(const numbered_sets& regions, std::uint32_t patch_count)
        : regions_(regions),
          begin_(regions.count() + 1, 0),
          patches_(2 * std::size_t{patch_count}) {
        for (std::uint32_t p = 0; p < patch_count; ++p) {
            ++begin_[front(p)];
            ++begin_[behind(p)];
        }
        std::size_t total = 0;
        for (std::size_t& begin : begin_) begin = total += begin;
        for (std::uint32_t p = patch_count; p-- > 0;) {
            patches_[--begin_[front(p)]] = p;
            patches_[--begin_[behind(p)]] = p;
        }
    }

    [[nodiscard]] std::uint32_t front(std::uint32_t patch) const {
        return regions_[2 * std::size_t{patch} + 1];
    }
    [[nodiscard]] std::uint32_t behind(std::uint32_t patch) const {
        return regions_[2 * std::size_t{patch} + 2];
    }
    /// The region on the other side of a patch.
    [[nodiscard]] std::uint32_t beyond(std::uint32_t patch, std::uint32_t region) const {
        return front(patch) == region ? behind(patch) : front(patch);
    }
    /// The patches around a region, ascending; a patch with the region on both sides occurs twice.
    [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t region) const {
        return {patches_.data() + begin_[region], begin_[region + 1] - begin_[region]};
    }

  private:
    const numbered_sets& regions_;
    std::vector<std::size_t> begin_;      ///< begin of the patches of each region
    std::vector<std::uint32_t> patches_;  ///< patches, region by region
};

}  // namespace treeform::detail::arrange
