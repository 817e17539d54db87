#pragma once
/// \file
/// Pairs of triangles that are hard to decide: kinds of trouble, each a seeded stream of pairs.
///
/// A stream is the same on every machine: it uses no library distribution and no function that
/// is not correctly rounded. Every family yields pairs that touch, overlap, miss by a rounding
/// error or are degenerate, beside plain ones. Half of the pairs are placed by exact steps (axes
/// exchanged, a translation by 0, 1, 1e3, 1e6 or 1e9, a scale by a power of two), half by rounding
/// ones (a rotation, the same translations, a scale from 1e-30 to 1e30); of both, half are then
/// rounded to float.

#include <treeform/mesh/predicates.hpp>

#include <support/stress_random.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace treeform::test {

enum class stress_family : std::uint8_t {
    near_coplanar,    ///< tilted against each other by 1e-1 to 1e-16, or not at all
    slivers,          ///< needles of an aspect up to 1e12 through a point of the other
    coplanar_grid,    ///< lattice triangles in one plane, faces of stacked cubes
    cad_grid,         ///< corners on a coarse grid of step 1/8, 0.1 or 1e-3
    large_offsets,    ///< small shapes up to 1e15 away from the origin
    mixed_scales,     ///< one triangle 1e12 times the other's size
    extreme_range,    ///< denormals, 1e-150, 1e150, 1e300, zeros of either sign, side by side
    fans,             ///< neighbors and others around a corner of up to 1e5 triangles
    duplicates,       ///< copies, flipped copies, copies with a corner moved
    one_ulp,          ///< neighbors on a sheet, one of them rotated by about one ulp
    thin_shells,      ///< copies moved by 1 to 10 ulps
    pencils,          ///< planes through one line or point
    soup,             ///< random corners
    on_plane_by_ulp,  ///< corners put on the other's features, then moved by 0 or 1 ulp
    broken_surfaces   ///< neighbors that do not fit, fold back or have few digits
};
inline constexpr std::size_t stress_family_count = 15;

[[nodiscard]] std::string_view name_of(stress_family family);
[[nodiscard]] std::optional<stress_family> stress_family_named(std::string_view name);

struct triangle_pair {
    triangle3 a;
    triangle3 b;
};

class stress_stream {
  public:
    stress_stream(stress_family family, std::uint64_t seed) : family_(family), random_(seed) {}

    /// The next pair; all coordinates are finite.
    [[nodiscard]] triangle_pair next();

  private:
    stress_family family_;
    random_source random_;
};

}  // namespace treeform::test
