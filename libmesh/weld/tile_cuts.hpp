#pragma once
/// \file
/// Divides space into tiles.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// A recursive division of space by planes with three fixed normals, which are not axis-aligned.
/// Every point, in the sample or not, is in exactly one tile. Of two points within the tolerance of
/// each other, each is in the tile of the other or in its halo.
class TREEFORM_API tile_cuts {
  public:
    /// Makes at most `count` tiles with about equal numbers of points of `sample`, which are
    /// finite.
    ///
    /// \throws std::invalid_argument for a count of 0 or a tolerance that is negative or not finite
    /// \cost O(n log n) for n points of the sample
    tile_cuts(points_view sample, double tolerance, std::size_t count);

    [[nodiscard]] std::size_t size() const { return size_; }

    struct node {
        std::uint32_t direction = leaf;
        /// number of the upper child; the lower one is the next node. For a leaf: the tile
        std::uint32_t above = 0;
        double cut = 0.0;  ///< positions >= `cut` along the direction are above
    };
    /// The nodes, from which an equal object can be constructed.
    [[nodiscard]] std::span<const node> nodes() const { return nodes_; }
    tile_cuts(std::vector<node> nodes, double tolerance);

    /// Returns the tile that the point is in. Replaces the content of `halos` by the other tiles
    /// that have it in their halo.
    ///
    /// \pre `p` is finite
    [[nodiscard]] std::uint32_t find(const point3& p, std::vector<std::uint32_t>& halos) const;

  private:
    static constexpr std::uint32_t leaf = 3;

    std::uint32_t split(std::span<point3> sample, std::size_t count);

    double tolerance_;
    std::uint32_t size_ = 0;
    std::vector<node> nodes_{};
};

}  // namespace treeform::detail::weld
