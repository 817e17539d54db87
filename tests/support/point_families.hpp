#pragma once
/// \file
/// Points that are hard to decide about: seeded streams of groups of points, a group for a call.

#include <treeform/mesh/mesh.hpp>

#include <support/stress_families.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace treeform::test {

enum class point_family : std::uint8_t {
    random,        ///< uniform doubles
    float_born,    ///< the same, rounded to 24 bits
    rounded_flat,  ///< computed to lie in a plane, on a line or at a point, and rounded
    exact_flat,    ///< exactly there, each coordinate then moved by 0 or +-1 ulp, or none
    grid,          ///< few whole steps of 1, 1/8 or 0.1
    offset,        ///< exactly flat shapes, far from the origin
    mixed_scales,  ///< 1e-6 beside 1e6
    denormal,      ///< multiples of the smallest denormal
    extreme,       ///< any exponents, zeros of either sign, repeated coordinates
};
inline constexpr std::array<std::string_view, 9> point_family_names = {
    "random", "float_born",   "rounded_flat", "exact_flat", "grid",
    "offset", "mixed_scales", "denormal",     "extreme"};

class point_stream {
  public:
    point_stream(point_family family, std::uint64_t seed) : family_(family), random_(seed) {}

    /// `count` points that belong together; all coordinates are finite.
    [[nodiscard]] std::vector<point3> next(std::size_t count);

  private:
    [[nodiscard]] point3 any(double scale);
    [[nodiscard]] double extreme(int least, int spread);
    [[nodiscard]] double moved(double x);
    [[nodiscard]] std::vector<point3> flat(std::size_t count, bool rounded, double offset);

    point_family family_;
    random_source random_;
};

template <class Function>
std::vector<point3> each(std::vector<point3> points, const Function& f) {
    for (point3& p : points) p = {f(p.x), f(p.y), f(p.z)};
    return points;
}

}  // namespace treeform::test
