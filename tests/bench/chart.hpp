#pragma once
/// \file
/// Pictures of measurements as SVG: lines, bars, heat maps, in one style for light and dark pages.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::bench {

/// Which color stands for a contestant, 1 to 8, the same in all pictures; who is not known by name
/// gets the color of `otherwise`.
[[nodiscard]] int tone_of(std::string_view who, std::size_t otherwise = 0);

struct axis {
    std::string label;  ///< what and its unit: "build time, ms"
    bool logarithmic = false;
};

/// What all pictures say around the data.
struct caption {
    std::string title;
    std::string machine;  ///< stands in the picture, so that it can travel alone
};

struct curve {
    std::string name;                           ///< stands at its right end
    std::vector<std::array<double, 2>> points;  ///< x, y; positive on logarithmic axes
    int tone = 1;
    bool dashed = false;  ///< for what was not measured here, or is second to another curve
};
struct line_chart {
    bench::caption caption;
    axis x;
    axis y;
    std::vector<curve> curves;
};

struct bar_series {
    std::string name;
    std::vector<double> values;  ///< [groups], 0 for none
    int tone = 1;
};
struct bar_chart {
    bench::caption caption;
    axis y;
    std::vector<std::string> groups{};
    std::vector<bar_series> series{};
    double line = 0.0;  ///< a value to compare with, drawn across; 0 for none
};

/// Values are shares of 1: above it one color, below it another, the stronger the further off.
struct heat_map {
    bench::caption caption;
    std::string x_label;
    std::string y_label;
    std::vector<std::string> columns{};
    std::vector<std::string> rows{};
    std::vector<std::vector<double>> values{};  ///< [rows][columns], 0 for none
};

/// The picture as the text of an SVG file that needs nothing else. Every mark has its value as a
/// tooltip. Text is escaped; charts without data are empty frames.
[[nodiscard]] std::string svg(const line_chart& chart);
[[nodiscard]] std::string svg(const bar_chart& chart);
[[nodiscard]] std::string svg(const heat_map& chart);

/// `text` with the characters that mean something in SVG and HTML written as entities.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace treeform::bench
