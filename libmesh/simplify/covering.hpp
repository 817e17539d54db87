#pragma once
/// \file
/// Proves that a triangle is within a distance of other triangles.

#include <libmesh/geometry/based_triangle.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::simplify {

/// A target triangle, prepared for distance computations.
struct target {
    triangle3 corners;
    geometry::based_triangle based;
    aabb<double, 3> box;

    target() = default;
    explicit target(const triangle3& t) : corners(t), based(t) {
        for (const point3& p : t) box.include(p);
    }
};

/// Divides a triangle into pieces, each within a distance of a single target. The distance to a
/// convex set is convex, so it suffices to test the corners of a piece.
class covering {
  public:
    struct use {
        std::uint32_t number = 0;  ///< number of the target
        /// bound of the distance to the target, for the pieces assigned to it
        double at_most = 0.0;
    };

    /// \param largest no coordinate of a triangle has a larger magnitude
    explicit covering(double largest) : unit_(0x1p-53 * largest) {}

    /// Returns whether every point of `t` is proven to be within `distance` of one of `by`. If so,
    /// `used` has the targets and their bounds. Otherwise `t` is farther away, or the proof takes
    /// too many pieces.
    ///
    /// Barycentric coordinates of the corners of pieces are regarded as exact, since pieces cover
    /// the triangle in any case. With M the largest coordinate and u = 2^-53, the computed position
    /// of a corner is off by at most 9 u M for each cut that it results from: a difference, a
    /// product and a sum of at most 2, 2 and 1 M on each axis. `closest_point` is off by 8 u times
    /// 2 sqrt(3) M; root and square of the distance by less than 12 u M.
    [[nodiscard]] bool cover(const triangle3& t, std::span<const target> by, double distance);

    [[nodiscard]] const std::vector<use>& used() const { return used_; }

  private:
    struct piece {
        std::array<point3, 12> corners{};
        std::uint32_t count = 0;
        std::uint32_t cuts = 0;  ///< maximum number of cuts that a corner results from
        /// range in `near_`: the targets near the piece
        std::uint32_t near_begin = 0, near_end = 0;
    };
    struct halves {
        piece behind, before;
    };
    [[nodiscard]] bool settle(std::span<const target> by, double distance);
    [[nodiscard]] bool cut_along(const piece& whole, const triangle3& at);
    [[nodiscard]] static halves halves_of(const piece& of, const point3& at, const point3& normal);
    void halve(const piece& whole);
    void use_of(std::uint32_t number, double at_most);

    double unit_;
    std::vector<piece> left_{};
    std::vector<std::uint32_t> near_{};
    std::vector<use> used_{};
};

}  // namespace treeform::detail::simplify
