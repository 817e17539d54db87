#pragma once
/// \file
/// A coarse bit grid of the space that faces occupy.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::round {

/// 64 x 64 x 64 cells of a box, with a bit for each cell into which the box of a face reaches.
/// Size: 64 kB.
///
/// The cell number is a monotone function of the coordinate, even with rounding, and coordinates
/// beyond the box are in the outermost cell. So the cells of a face's box are those between the
/// cells of its corners, and boxes that overlap have a common cell.
class coarse_grid {
  public:
    /// The cell numbers along x, y and z, in the three lowest bytes.
    using cell = std::uint32_t;

    explicit coarse_grid(const aabb<double, 3>& reach) : low_(reach.min), rows_(side * side, 0) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double extent = reach.max[k] - reach.min[k];
            scale_[k] = extent > 1e-290 && extent < 1e290 ? side / extent : 0.0;
        }
    }

    /// \pre the point is finite
    [[nodiscard]] cell cell_of(const point3& p) const {
        cell c = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (scale_[k] != 0.0)
                c |= static_cast<cell>(std::clamp((p[k] - low_[k]) * scale_[k], 0.0, side - 1.0))
                     << (8 * k);
        return c;
    }

    /// Marks the cells of the box of a face, from the cells of its corners. May be called from
    /// several threads at once.
    void add(cell a, cell b, cell c) {
        const range all(a, b, c);
        const std::atomic_ref is_full(is_full_);
        if (all.rows() > most_rows) is_full.store(true, std::memory_order_relaxed);
        if (is_full.load(std::memory_order_relaxed)) return;
        for (std::size_t z = all.first[2]; z <= all.last[2]; ++z)
            for (std::size_t y = all.first[1]; y <= all.last[1]; ++y) {
                const std::atomic_ref row(rows_[z * side + y]);
                if ((all.row() & ~row.load(std::memory_order_relaxed)) != 0)  // seldom
                    row.fetch_or(all.row(), std::memory_order_relaxed);
            }
    }

    /// Call it after all faces were added.
    void finish() {
        around_.assign(rows_.size(), 0);
        for (std::size_t z = 0; z < side; ++z)
            for (std::size_t y = 0; y < side; ++y) {
                const std::uint64_t row = rows_[z * side + y];
                const std::uint64_t wider = row | row << 1 | row >> 1;
                if (row == 0) continue;
                for (std::size_t v = z == 0 ? 0 : z - 1; v <= std::min(z + 1, side - 1); ++v)
                    for (std::size_t u = y == 0 ? 0 : y - 1; u <= std::min(y + 1, side - 1); ++u)
                        around_[v * side + u] |= wider;
            }
    }

    /// False only if the face's box overlaps the box of no added face.
    [[nodiscard]] bool may_meet(cell a, cell b, cell c) const {
        if (!is_full_ && touch(a, b) && touch(a, c) && !is_around(a)) return false;  // nearly all
        const range all(a, b, c);
        if (is_full_ || all.rows() > most_rows) return true;
        for (std::size_t z = all.first[2]; z <= all.last[2]; ++z)
            for (std::size_t y = all.first[1]; y <= all.last[1]; ++y)
                if ((rows_[z * side + y] & all.row()) != 0) return true;
        return false;
    }

  private:
    static constexpr std::size_t side = 64;
    static constexpr std::size_t most_rows = 256;  // larger boxes are not worth testing

    /// Whether no coordinate of the cells differs by more than 1: then 128 + a - b + 1 is 128 to
    /// 130 in each byte, and so is 128 + b - a + 1.
    static bool touch(cell a, cell b) {
        constexpr cell top = 0x808080, one = 0x010101, all_but_low = 0xFCFCFC;
        return (((((a | top) - b + one) ^ top) | (((b | top) - a + one) ^ top)) & all_but_low) == 0;
    }
    /// Whether the cell, or a cell that touches it, is marked.
    [[nodiscard]] bool is_around(cell c) const {
        return (around_[(c >> 16) * side + (c >> 8 & 0xFFU)] >> (c & 0xFFU) & 1U) != 0;
    }

    struct range {
        std::array<std::uint8_t, 3> first, last;
        range(cell a, cell b, cell c) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto number = [k](cell at) {
                    return static_cast<std::uint8_t>(at >> (8 * k) & 0xFFU);
                };
                first[k] = std::min(std::min(number(a), number(b)), number(c));
                last[k] = std::max(std::max(number(a), number(b)), number(c));
            }
        }
        [[nodiscard]] std::size_t rows() const {
            return std::size_t{last[1] - first[1] + 1U} * (last[2] - first[2] + 1U);
        }
        [[nodiscard]] std::uint64_t row() const {
            return (~std::uint64_t{0} >> (side - 1 - last[0] + first[0])) << first[0];
        }
    };

    std::array<double, 3> low_;
    std::array<double, 3> scale_{};
    std::vector<std::uint64_t> rows_;    ///< rows along x, with a bit for each cell
    std::vector<std::uint64_t> around_;  ///< the same, with all cells that touch marked cells
    bool is_full_ = false;
};

}  // namespace treeform::detail::round
