#include "tools/picture/halo.hpp"

#include <algorithm>

namespace tools {
namespace {

constexpr unsigned halo_share = 140;  // of 256

}  // namespace

void add_halos(picture& on, const std::vector<std::uint8_t>& found,
               const std::vector<rgb>& colors) {
    if (std::all_of(found.begin(), found.end(), [](std::uint8_t f) { return f == 0; })) return;
    const std::size_t reach = std::clamp<std::size_t>(on.width / 300, 1, 8);
    // sums[y][x]: pixels found above and to the left, for the count in any box by four of them.
    const std::size_t row = on.width + 1;
    std::vector<std::uint32_t> sums(row * (on.height + 1), 0);
    for (std::size_t y = 0; y < on.height; ++y)
        for (std::size_t x = 0; x < on.width; ++x)
            sums[(y + 1) * row + x + 1] = (found[y * on.width + x] != 0 ? 1U : 0U) +
                                          sums[y * row + x + 1] + sums[(y + 1) * row + x] -
                                          sums[y * row + x];
    std::vector<std::uint8_t> halo(found.size(), 0);
    for (std::size_t y = 0; y < on.height; ++y)
        for (std::size_t x = 0; x < on.width; ++x) {
            const std::uint8_t kind = found[y * on.width + x];
            if (kind == 0) continue;
            const std::size_t x0 = x - std::min(x, reach), x1 = std::min(x + reach + 1, on.width);
            const std::size_t y0 = y - std::min(y, reach), y1 = std::min(y + reach + 1, on.height);
            const std::uint32_t near = sums[y1 * row + x1] - sums[y0 * row + x1] -
                                       sums[y1 * row + x0] + sums[y0 * row + x0];
            if (near > 2 * reach + 1) continue;
            for (std::size_t j = y0; j < y1; ++j)
                for (std::size_t i = x0; i < x1; ++i) {
                    const std::size_t dx = i > x ? i - x : x - i, dy = j > y ? j - y : y - j;
                    std::uint8_t& there = halo[j * on.width + i];
                    if (dx * dx + dy * dy <= reach * reach && there == 0) there = kind;
                }
        }
    for (std::size_t i = 0; i < halo.size(); ++i)
        if (halo[i] != 0 && found[i] == 0)
            on.pixels[i] = blended(on.pixels[i], colors[halo[i] - 1U], halo_share);
}

}  // namespace tools
