#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace treeform::detail {
namespace {

constexpr std::size_t few = 32;

struct coded {
    std::uint32_t code;
    std::uint32_t index;
};

template <std::size_t D>
struct extent {
    std::array<double, D> low;
    std::array<double, D> high;
};

/// Halved coordinates, so that the extent of extreme ones is finite.
template <std::size_t D>
extent<D> extent_of(std::size_t count, function_ref<std::array<double, D>(std::size_t)> point_of) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    extent<D> none;
    none.low.fill(infinity);
    none.high.fill(-infinity);
    std::vector<extent<D>> parts(chunk_count(count, light_grain), none);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        extent<D> mine = none;
        for (std::size_t i = begin; i < end; ++i) {
            const std::array<double, D> p = point_of(i);
            for (std::size_t k = 0; k < D; ++k) {
                const double x = 0.5 * p[k];
                if (!std::isfinite(x)) continue;
                mine.low[k] = std::min(mine.low[k], x);
                mine.high[k] = std::max(mine.high[k], x);
            }
        }
        parts[chunk] = mine;
    });
    extent<D> all = none;
    for (const extent<D>& part : parts)
        for (std::size_t k = 0; k < D; ++k) {
            all.low[k] = std::min(all.low[k], part.low[k]);
            all.high[k] = std::max(all.high[k], part.high[k]);
        }
    return all;
}

/// The lowest 10 bits three apart, or the lowest 16 two apart.
template <std::size_t D>
std::uint32_t spread(std::uint32_t x) {
    if constexpr (D == 3) {
        x = (x | x << 16) & 0x030000FF;
        x = (x | x << 8) & 0x0300F00F;
        x = (x | x << 4) & 0x030C30C3;
        return (x | x << 2) & 0x09249249;
    } else {
        x = (x | x << 8) & 0x00FF00FF;
        x = (x | x << 4) & 0x0F0F0F0F;
        x = (x | x << 2) & 0x33333333;
        return (x | x << 1) & 0x55555555;
    }
}

/// Stable, by one digit of 11 bits.
void sort_by_digit(const std::vector<coded>& from, std::vector<coded>& to, unsigned shift) {
    std::array<std::size_t, 2049> place{};
    for (const coded& c : from) ++place[(c.code >> shift & 2047) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const coded& c : from) to[place[c.code >> shift & 2047]++] = c;
}

}  // namespace

template <std::size_t D>
std::vector<std::uint32_t> morton_order(std::size_t count,
                                        function_ref<std::array<double, D>(std::size_t)> point_of) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    if (count <= few) return order;
    constexpr unsigned cells = D == 3 ? 1U << 10 : 1U << 16;
    const extent<D> all = extent_of<D>(count, point_of);
    double side = 0.0;
    for (std::size_t k = 0; k < D; ++k) side = std::max(side, all.high[k] - all.low[k]);
    if (!(side > 0.0)) return order;
    std::vector<coded> codes(count);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::array<double, D> p = point_of(i);
            std::uint32_t code = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const double at = (0.5 * p[k] - all.low[k]) / side * cells;
                const auto cell =
                    at > 0.0 ? static_cast<std::uint32_t>(std::min(at, cells - 1.0)) : 0U;
                code |= spread<D>(cell) << k;
            }
            codes[i] = {code, static_cast<std::uint32_t>(i)};
        }
    });
    std::vector<coded> other(count);
    sort_by_digit(codes, other, 0);
    sort_by_digit(other, codes, 11);
    sort_by_digit(codes, other, 22);
    for (std::size_t i = 0; i < count; ++i) order[i] = other[i].index;
    return order;
}

template TREEFORM_API std::vector<std::uint32_t> morton_order(
    std::size_t, function_ref<std::array<double, 2>(std::size_t)>);
template TREEFORM_API std::vector<std::uint32_t> morton_order(
    std::size_t, function_ref<std::array<double, 3>(std::size_t)>);

}  // namespace treeform::detail
