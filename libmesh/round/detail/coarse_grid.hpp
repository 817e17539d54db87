#pragma once
/// \file
/// Where in space faces are, roughly.

#include <libmesh/mesh.hpp>
#include <libtree/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tf::detail {

/// 64 x 64 x 64 cells of a box, and which of them the boxes of faces reach into, a bit each: 32 kB.
///
/// The cell of a coordinate never goes down when the coordinate goes up, however it is rounded, and
/// what is beyond the box counts for the last cell. So the cells of a face's box are those between
/// the cells of its corners, and boxes that overlap have a cell in common.
class coarse_grid {
  public:
    using cell = std::array<std::uint8_t, 3>;

    explicit coarse_grid(const aabb<double, 3>& reach) : low_(reach.min), rows_(side * side, 0) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double extent = reach.max[k] - reach.min[k];
            scale_[k] = extent > 1e-290 && extent < 1e290 ? side / extent : 0.0;
        }
    }

    /// \pre the point is finite
    [[nodiscard]] cell cell_of(const point3& p) const {
        cell c{};
        for (std::size_t k = 0; k < 3; ++k)
            if (scale_[k] != 0.0)
                c[k] = static_cast<std::uint8_t>(
                    std::clamp((p[k] - low_[k]) * scale_[k], 0.0, side - 1.0));
        return c;
    }

    void add(const cell& a, const cell& b, const cell& c) {
        const range all(a, b, c);
        if (all.rows() > most_rows) is_full_ = true;
        if (is_full_) return;
        for (std::size_t z = all.first[2]; z <= all.last[2]; ++z)
            for (std::size_t y = all.first[1]; y <= all.last[1]; ++y)
                rows_[z * side + y] |= all.row();
    }

    /// False only if the face's box overlaps none of those that were added.
    [[nodiscard]] bool may_meet(const cell& a, const cell& b, const cell& c) const {
        const range all(a, b, c);
        if (is_full_ || all.rows() > most_rows) return true;
        for (std::size_t z = all.first[2]; z <= all.last[2]; ++z)
            for (std::size_t y = all.first[1]; y <= all.last[1]; ++y)
                if ((rows_[z * side + y] & all.row()) != 0) return true;
        return false;
    }

  private:
    static constexpr std::size_t side = 64;
    static constexpr std::size_t most_rows = 256;  // what reaches further is not worth the while

    struct range {
        cell first, last;
        range(const cell& a, const cell& b, const cell& c) {
            for (std::size_t k = 0; k < 3; ++k) {
                first[k] = std::min(std::min(a[k], b[k]), c[k]);
                last[k] = std::max(std::max(a[k], b[k]), c[k]);
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
    std::vector<std::uint64_t> rows_;  ///< along x, a bit a cell
    bool is_full_ = false;
};

}  // namespace tf::detail
