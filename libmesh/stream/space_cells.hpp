#pragma once
/// \file
/// Divides space into cells by axis-aligned planes (a k-d tree), so that each has about the same
/// share of a sample.

#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::stream {

/// Each point is in one cell: a cell contains its low faces, but not its high ones. Cells are
/// nearly cubic, so that few elements reach into several of them.
class space_cells {
  public:
    /// At most `count` cells. \pre the points are finite \cost O(n log n) time for n points
    space_cells(std::vector<point3> sample, std::size_t count);
    /// Loads cells from `store`.
    explicit space_cells(state_reader& state);
    void store(state_writer& state) const;

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::uint32_t cell_of(const point3& p) const;

    /// Calls `take(cell)` for each cell that has a point of the closed box.
    template <class Take>
    void each_that_meets(const box3& box, const Take& take) const {
        visit(0, box, take);
    }

  private:
    static constexpr std::size_t no_axis = 3;
    struct node {
        double cut = 0.0;
        /// the node for coordinates from `cut` on; that for lower ones is the next node
        std::uint32_t high = 0;
        std::uint32_t cell = 0;  ///< for a leaf (no axis)
        std::size_t axis = no_axis;
    };

    template <class Take>
    void visit(std::uint32_t at, const box3& box, const Take& take) const {
        const node& n = nodes_[at];
        if (n.axis == no_axis) return take(n.cell);
        if (box.min[n.axis] < n.cut) visit(at + 1, box, take);
        if (box.max[n.axis] >= n.cut) visit(n.high, box, take);
    }

    std::vector<node> nodes_{};
    std::size_t size_ = 0;
};

}  // namespace treeform::detail::stream
