#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/solid_angle.hpp>

#include <array>
#include <cmath>

namespace treeform::detail::geometry {
namespace {

constexpr double quarter_turn = 1.5707963267948966;
constexpr double eighth_of_turn = 0.7853981633974483;

/// The angle with tangent t, for t in [0, 1].
///
/// Beyond tan(pi/8) = 0.41421 the angle to pi/4 is taken, whose tangent is (t - 1) / (t + 1) and no
/// larger than that. There the series t - t^3/3 + t^5/5 - ... has falling terms of changing sign,
/// so what is left out is less than the first term left out: 0.4143^25 / 25 < 1.2e-11. Rounding
/// adds less than ten units in the last place.
double angle_with_tangent(double t) {
    constexpr double tangent_of_half = 0.41421356237309503;
    constexpr std::array shares{1.0 / 23, 1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13,
                                1.0 / 11, 1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3,  1.0};
    const bool is_steep = t > tangent_of_half;
    const double u = is_steep ? (t - 1.0) / (t + 1.0) : t;
    const double v = u * u;
    double sum = 0.0;
    for (const double share : shares) sum = share - v * sum;
    return (is_steep ? eighth_of_turn : 0.0) + u * sum;
}

}  // namespace

double angle_of(double y, double x) {
    const double across = std::abs(y), along = std::abs(x);
    if (across == 0.0 && along == 0.0) return 0.0;
    double angle = across <= along ? angle_with_tangent(across / along)
                                   : quarter_turn - angle_with_tangent(along / across);
    if (x < 0.0) angle = 2.0 * quarter_turn - angle;
    return y < 0.0 ? -angle : angle;
}

double solid_angle(const point3& a, const point3& b, const point3& c) {
    const double x = std::sqrt(base::dot(a, a)), y = std::sqrt(base::dot(b, b)),
                 z = std::sqrt(base::dot(c, c));
    const double volume = base::dot(a, base::cross(b, c));
    const double rest = x * y * z + base::dot(a, b) * z + base::dot(b, c) * x + base::dot(c, a) * y;
    return 2.0 * angle_of(volume, rest);
}

}  // namespace treeform::detail::geometry
