#pragma once
/// \file
/// Space cut into tiles, and which of them know of a point.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Space cut by planes, and each part again. All points, also those of no sample, are in one tile;
/// points within the tolerance of each other are in tiles that know of both.
class TREEFORM_API tile_cuts {
  public:
    /// At most `count` tiles with about equal shares of `sample`, whose points are finite.
    ///
    /// \throws std::invalid_argument for a count of 0 or a tolerance that is negative or not finite
    /// \cost O(n log n) for n points of the sample
    tile_cuts(points_view sample, double tolerance, std::size_t count);

    [[nodiscard]] std::size_t size() const { return size_; }

    struct node {
        std::uint32_t direction = leaf;
        std::uint32_t above = 0;  ///< node; the one below is the next. Of a leaf: the tile
        double cut = 0.0;         ///< places from here on are above
    };
    /// What makes other cuts the same.
    [[nodiscard]] std::span<const node> nodes() const { return nodes_; }
    tile_cuts(std::vector<node> nodes, double tolerance);

    /// The tile that the point is in. The others whose halo it is in replace the content of
    /// `halos`.
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
