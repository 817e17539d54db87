#pragma once
/// \file
/// Whether points are within one distance of each other, and which is nearer: exactly. A tolerance:
/// its check at the door, and the cubes that it makes.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace treeform::detail::weld {

inline double rounded_squared_distance(const point3& a, const point3& b) {
    const double x = a.x - b.x;
    const double y = a.y - b.y;
    const double z = a.z - b.z;
    return x * x + y * y + z * z;
}

/// The result of comparing two rounded squared distances. Their relative error is within (1 +- u)^5
/// with u = 2^-53, so that the comparison of two such numbers (or of one with a rounded square)
/// that differ by more than 1 part in 2^48 is correct. Values near underflow or overflow are
/// `unsure`.
enum class order { less, more, unsure };
inline order compare_rounded(double a, double b) {
    constexpr double margin = 1.0 + 0x1p-48;
    constexpr double least = 0x1p-960;
    constexpr double greatest = 0x1p1000;
    if (!(a < greatest && b < greatest) || !(a > least || b > least)) return order::unsure;
    if (a * margin < b) return order::less;
    if (b * margin < a) return order::more;
    return order::unsure;
}

/// Exact comparisons with a fixed distance, which is finite and not negative.
class reach {
  public:
    explicit reach(double distance) : distance_(distance), square_(distance * distance) {}

    [[nodiscard]] double distance() const { return distance_; }

    [[nodiscard]] bool holds(const point3& a, const point3& b) const {
        const order known = compare_rounded(rounded_squared_distance(a, b), square_);
        if (known != order::unsure) return known == order::less;
        return compare_distance(a, b, {}, {distance_, 0.0, 0.0}) <= 0;
    }

    /// Sign of |p - a| - |p - b|.
    [[nodiscard]] static int compare(const point3& p, const point3& a, const point3& b) {
        const order known =
            compare_rounded(rounded_squared_distance(p, a), rounded_squared_distance(p, b));
        if (known != order::unsure) return known == order::less ? -1 : 1;
        return compare_distance(p, a, p, b);
    }

  private:
    double distance_;
    double square_;
};

/// Number of cube edges in a tolerance, such that all points in a cube are within the tolerance of
/// each other: the diagonal of a cube is less than it (except where rounding makes a denormal width
/// larger). Points within the tolerance are at most two cubes apart along each axis.
inline constexpr double cubes_per_tolerance = 1.7321 * (1.0 + 0x1p-10);

/// \throws std::invalid_argument naming the function `called`
inline void check_tolerance(const char* called, double tolerance) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
        throw std::invalid_argument(std::string("treeform::") + called +
                                    ": the tolerance must be finite and not negative");
}

/// The nearest of the points considered; ties: the lowest number. Every implementation of the rule
/// `first` uses it (lists of pairs, cubes, tiles and their borders).
class nearest_kept {
  public:
    explicit nearest_kept(const point3& p) : p_(p) {}

    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] std::uint64_t id() const { return id_; }
    [[nodiscard]] const point3& at() const { return at_; }

    void consider(std::uint64_t id, const point3& at) {
        if (any_ && !precedes(id, at)) return;
        any_ = true;
        id_ = id;
        at_ = at;
    }
    /// Whether the given point is preferred to the current nearest one. \pre any()
    [[nodiscard]] bool precedes(std::uint64_t id, const point3& at) const {
        const int order = reach::compare(p_, at, at_);
        return order < 0 || (order == 0 && id < id_);
    }

  private:
    point3 p_;
    point3 at_{};
    std::uint64_t id_ = 0;
    bool any_ = false;
};

}  // namespace treeform::detail::weld
