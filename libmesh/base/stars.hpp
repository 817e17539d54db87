#pragma once
/// \file
/// The faces at each point of a mesh.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace treeform::detail::base {

[[nodiscard]] inline bool has_three_corners(const face& f) {
    return f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
}

/// How many points faces can name: corners are 32-bit numbers.
[[nodiscard]] inline std::size_t nameable_points(std::size_t point_count) {
    constexpr std::size_t most = std::size_t{std::numeric_limits<std::uint32_t>::max()} + 1;
    return std::min(point_count, most);
}

/// For each point, the numbers of the faces with three different corners that have it as one.
///
/// \pre  every corner is less than `point_count`
/// \cost O(V + F) time, 12 bytes a face and 8 a point
/// \same on any number of threads
class stars {
  public:
    stars(std::size_t point_count, std::span<const face> faces);

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// The faces at `point`, ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t point) const {
        return {faces_.data() + begin_[point], begin_[point + 1] - begin_[point]};
    }
    /// Faces with three different corners.
    [[nodiscard]] std::size_t face_count() const { return faces_.size() / 3; }

  private:
    buffer<std::size_t> begin_;    ///< [V + 1] where the faces of each point begin in `faces_`
    buffer<std::uint32_t> faces_;  ///< point by point
};

}  // namespace treeform::detail::base
