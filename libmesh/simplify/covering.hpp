#pragma once
/// \file
/// Proof that a triangle is within a distance of others.

#include <libmesh/geometry/based_triangle.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::simplify {

/// A triangle that others may be near, made ready for distances.
struct target {
    triangle3 corners;
    geometry::based_triangle based;
    aabb<double, 3> box;

    target() = default;
    explicit target(const triangle3& t) : corners(t), based(t) {
        for (const point3& p : t) box.include(p);
    }
};

/// Cuts a triangle into pieces, each of which is within a distance of a single one of others: as
/// distance from a convex set is convex, corners of a piece tell.
class covering {
  public:
    struct use {
        std::uint32_t number = 0;  ///< of the other
        double at_most = 0.0;      ///< no point that it stands for is further from it
    };

    /// \param largest no coordinate of a triangle has a larger magnitude
    explicit covering(double largest) : unit_(0x1p-53 * largest) {}

    /// Whether it is proven: else it is further away, or takes too many pieces. What is proven is
    /// in `used` then.
    ///
    /// Numbers that corners of pieces have within the triangle are taken as exact, whatever they
    /// are: pieces cover it. With M the largest coordinate and u = 2^-53, a corner is where they
    /// say to 9 u M for each cut that it comes of: a difference, a product and a sum of at most 2,
    /// 2 and 1 M on each axis. `closest_point` is off by 8 u times 2 sqrt(3) M, root and square of
    /// the distance by less than 12 u M.
    [[nodiscard]] bool cover(const triangle3& t, std::span<const target> by, double distance);

    [[nodiscard]] const std::vector<use>& used() const { return used_; }

  private:
    struct piece {
        std::array<point3, 12> corners{};
        std::uint32_t count = 0;
        std::uint32_t cuts = 0;                      ///< that a corner comes of, at most
        std::uint32_t near_begin = 0, near_end = 0;  ///< in `near_`, what it is near
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
