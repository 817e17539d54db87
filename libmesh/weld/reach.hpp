#pragma once
/// \file
/// Exact comparisons of distances between points.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

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

}  // namespace treeform::detail::weld
