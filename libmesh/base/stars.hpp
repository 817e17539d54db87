#pragma once
/// \file
/// The faces at each point of a mesh.

#include <libmesh/base/fill_stars.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace treeform::detail::base {

[[nodiscard]] inline bool has_three_corners(const face& f) {
    return f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
}

/// Largest number of points that corners, which are 32-bit numbers, can refer to.
[[nodiscard]] inline std::size_t nameable_points(std::size_t point_count) {
    constexpr std::size_t most = std::size_t{std::numeric_limits<std::uint32_t>::max()} + 1;
    return std::min(point_count, most);
}

/// For each point, the faces with three different corners in which it is a corner, but not the
/// highest: those with edges from it to higher points. So every edge is listed once, at its lower
/// end.
/// \cost as `fill_stars`
template <class Index>
[[nodiscard]] faces_by_point<Index> faces_at_lower_ends(std::size_t point_count,
                                                        std::span<const face> faces) {
    return fill_stars<Index>(nameable_points(point_count), faces.size(),
                             [&](std::size_t i, const auto& visit) {
                                 if (!has_three_corners(faces[i])) return;
                                 const auto& [a, b, c] = faces[i];
                                 const std::uint32_t low = std::min(std::min(a, b), c);
                                 const std::uint32_t high = std::max(std::max(a, b), c);
                                 visit(low);
                                 visit(a ^ b ^ c ^ low ^ high);
                             });
}

/// For each point, its star: the numbers of the faces with three different corners at it.
///
/// \pre  every corner is less than `point_count`
/// \cost O(V + F) time, in parallel; 12 bytes a face and 8 a point; temporarily 24 more a face
/// \same on any number of threads
class stars {
  public:
    stars(std::size_t point_count, std::span<const face> faces);

    [[nodiscard]] std::size_t size() const { return at_.end.size(); }
    /// The faces at `point`, ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t point) const {
        return at_[point];
    }
    /// Number of faces with three different corners.
    [[nodiscard]] std::size_t face_count() const { return at_.faces.size() / 3; }

  private:
    faces_by_point<std::size_t> at_;
};

}  // namespace treeform::detail::base
