#include "tools/picture/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace tools {
namespace {

/// The pixels of a side whose middles lie from `low` to `high`.
std::array<std::size_t, 2> range_of(double low, double high, std::size_t size) {
    const auto bound = [&](double at) {
        return static_cast<std::size_t>(
            std::clamp(std::ceil(at - 0.5), 0.0, static_cast<double>(size)));
    };
    return {bound(low), bound(high)};
}

double squared_distance(const std::array<pixel_position, 2>& s, double x, double y) {
    const double dx = s[1].x - s[0].x, dy = s[1].y - s[0].y;
    const double px = x - s[0].x, py = y - s[0].y;
    const double long2 = dx * dx + dy * dy;
    const double t = long2 > 0.0 ? std::clamp((px * dx + py * dy) / long2, 0.0, 1.0) : 0.0;
    const double ox = px - t * dx, oy = py - t * dy;
    return ox * ox + oy * oy;
}

}  // namespace

rgb color_of(std::string_view text) {
    rgb color{};
    for (std::size_t i = 0; i < 6 && i + 1 < text.size(); ++i) {
        const char c = text[i + 1];
        const int digit = c >= 'a' ? c - 'a' + 10 : c >= 'A' ? c - 'A' + 10 : c - '0';
        color[i / 2] = static_cast<std::uint8_t>(color[i / 2] * 16 + digit);
    }
    return color;
}

void fill(picture& on, const area& box, const rgb& color, unsigned share) {
    const auto [x0, x1] = range_of(box.x, box.x + box.width, on.width);
    const auto [y0, y1] = range_of(box.y, box.y + box.height, on.height);
    for (std::size_t y = y0; y < y1; ++y)
        for (std::size_t x = x0; x < x1; ++x) on.at(x, y) = blended(on.at(x, y), color, share);
}

void stroke(picture& on, std::span<const std::array<pixel_position, 2>> segments, double width,
            const rgb& color, unsigned share) {
    if (segments.empty()) return;
    pixel_position low = segments[0][0], high = low;
    for (const auto& s : segments)
        for (const pixel_position& p : s) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    const double reach = 0.5 * width + 0.5;
    const auto [x0, x1] = range_of(low.x - reach, high.x + reach, on.width);
    const auto [y0, y1] = range_of(low.y - reach, high.y + reach, on.height);
    for (std::size_t y = y0; y < y1; ++y)
        for (std::size_t x = x0; x < x1; ++x) {
            double least = reach * reach;
            for (const auto& s : segments)
                least = std::min(least, squared_distance(s, static_cast<double>(x) + 0.5,
                                                         static_cast<double>(y) + 0.5));
            const double cover = std::clamp(reach - std::sqrt(least), 0.0, 1.0);
            on.at(x, y) = blended(on.at(x, y), color, static_cast<unsigned>(share * cover + 0.5));
        }
}

}  // namespace tools
