#pragma once
/// \file
/// A picture in memory, and what is drawn on it flat: boxes and strokes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace tools {

/// Red, green and blue.
using rgb = std::array<std::uint8_t, 3>;

inline constexpr rgb ink{0x1c, 0x1f, 0x26};
inline constexpr rgb paper{0xff, 0xff, 0xff};

/// The color that "#rrggbb" names.
[[nodiscard]] rgb color_of(std::string_view text);

/// `share` of 256 parts of `over`, the rest of `under`.
[[nodiscard]] constexpr rgb blended(const rgb& under, const rgb& over, unsigned share) {
    rgb result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] =
            static_cast<std::uint8_t>((under[i] * (256U - share) + over[i] * share + 128U) / 256U);
    return result;
}

/// Pixels from the upper left. What lies outside is not drawn.
struct picture {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<rgb> pixels{};  ///< [height][width]

    picture() = default;
    picture(std::size_t w, std::size_t h) : width(w), height(h), pixels(w * h, paper) {}
    [[nodiscard]] rgb& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
    [[nodiscard]] const rgb& at(std::size_t x, std::size_t y) const {
        return pixels[y * width + x];
    }
};

/// In pixels; the middle of the first one is (0.5, 0.5).
struct pixel_position {
    double x = 0.0;
    double y = 0.0;
};
struct area {
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;
};

/// The pixels whose middles lie within it.
void fill(picture& on, const area& box, const rgb& color, unsigned share = 256);

/// Segments as one shape with round ends, its rim smooth.
void stroke(picture& on, std::span<const std::array<pixel_position, 2>> segments, double width,
            const rgb& color, unsigned share = 256);

}  // namespace tools
