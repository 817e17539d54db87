#include "bench/error_chart.hpp"

#include "bench/drawing.hpp"

#include <algorithm>
#include <cmath>

namespace treeform::bench {
namespace {

constexpr double exact_y = top + plot_height - 12;      // the line of the dots without error
constexpr double axis_bottom = top + plot_height - 40;  // where the least error is

/// Whole decades, every one or every few, so that labels do not touch.
std::vector<int> decades(double low, double high, int most) {
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    const int step = std::max(1, (last - first + most - 1) / most);
    std::vector<int> all;
    for (int i = first; i <= last; i += step) all.push_back(i);
    return all;
}

std::string power_of_ten(int exponent) {
    return exponent >= -3 && exponent <= 4 ? fmt::format("{:g}", std::pow(10, exponent))
                                           : fmt::format("1e{}", exponent);
}

bool drawable(const error_point& p) {
    return std::isfinite(p.time) && std::isfinite(p.error) && p.time > 0 && p.error >= 0;
}

class dots {
  public:
    dots(drawing& drawing, const scale& x, const scale& y) : drawing_(drawing), x_(x), y_(y) {}

    [[nodiscard]] std::array<double, 2> place(const error_point& p) const {
        return {x_(p.time), p.error > 0 ? y_(p.error) : exact_y};
    }
    void draw(const error_series& series) {
        if (series.joined) {
            std::vector<std::array<double, 2>> places;
            for (const error_point& p : series.points)
                if (drawable(p)) places.push_back(place(p));
            drawing_.path(places, of_tone('s', series.tone), true);
        }
        for (const error_point& p : series.points)
            if (drawable(p)) {
                const auto [x, y] = place(p);
                drawing_.shape(
                    x, y, series.shape, of_tone('f', series.tone),
                    fmt::format("{}{}{}: {:.4g} at {:.4g}", series.name,
                                p.setting.empty() ? "" : ", ", p.setting, p.error, p.time));
            }
    }

  private:
    drawing& drawing_;
    const scale& x_;
    const scale& y_;
};

/// Names in the order of the series, beside the plot.
void draw_names(drawing& drawing, const std::vector<error_series>& all, double right) {
    double y = top + 2;
    for (const error_series& series : all) {
        if (std::ranges::none_of(series.points, drawable)) continue;
        drawing.shape(right + 18, y, series.shape, of_tone('f', series.tone), series.name);
        drawing.text(right + 28, y + 4, series.name, "small", "start");
        y += 18;
    }
}

}  // namespace

std::string svg(const error_chart& chart) {
    std::size_t longest = 0;
    range xs, ys;
    for (const error_series& series : chart.series) {
        longest = std::max(longest, series.name.size());
        for (const error_point& p : series.points)
            if (drawable(p)) {
                xs.include(p.time);
                if (p.error > 0) ys.include(p.error);
            }
    }
    if (!(xs.low <= xs.high)) xs = {1, 10};
    if (!(ys.low <= ys.high)) ys = {1, 10};
    const double right = width - 40 - 6.4 * static_cast<double>(longest);
    const std::vector<int> rows = decades(ys.low, ys.high, 9);
    const scale x(xs.low * 0.8, xs.high * 1.25, true, left, right);
    const scale y(std::pow(10, rows.front()), std::max(std::pow(10, rows.back()), ys.high * 1.1),
                  true, axis_bottom, top);
    drawing drawing(chart.caption);
    for (const int row : rows) {
        const double at = y(std::pow(10, row));
        drawing.line(left, at, right, at, "grid");
        drawing.text(left - 8, at + 4, power_of_ten(row), "small", "end");
    }
    drawing.upright_text(20, top + plot_height / 2, chart.error_label);
    drawing.line(left, exact_y, right, exact_y, "axis", true);
    drawing.text(left - 8, exact_y + 4, chart.exact_label, "small", "end");
    for (const double tick : x.ticks())
        drawing.text(x(tick), top + plot_height + 18, short_number(tick), "small", "middle");
    drawing.line(left, top + plot_height, right, top + plot_height, "axis");
    drawing.text((left + right) / 2, top + plot_height + 38, chart.time_label, "", "middle");
    dots dots(drawing, x, y);
    for (const error_series& series : chart.series) dots.draw(series);
    draw_names(drawing, chart.series, right);
    return drawing.finished();
}

}  // namespace treeform::bench
