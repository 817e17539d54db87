#include "bench/error_chart.hpp"

#include "bench/drawing.hpp"

#include <algorithm>
#include <cmath>

namespace treeform::bench {
namespace {

constexpr double mark_size = 8;     // dots nearer than that cover each other
constexpr double farthest = 40;     // that a dot is moved
constexpr double lane_height = 11;  // of the line of an exact method
constexpr double plot_bottom = top + plot_height;

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

bool is_exact(const error_point& p) { return drawable(p) && p.error == 0; }

/// Of each series, the height of its line among the exact ones; and what is above all of them.
struct lanes {
    explicit lanes(const std::vector<error_series>& all) {
        const auto any = [](const error_series& series) {
            return std::ranges::any_of(series.points, is_exact);
        };
        const auto count =
            static_cast<double>(std::max<std::ptrdiff_t>(std::ranges::count_if(all, any), 1));
        upper = plot_bottom - lane_height * count - 4;
        double y = upper + lane_height / 2 + 2;
        for (const error_series& series : all) {
            of_series.push_back(y);
            if (any(series)) y += lane_height;
        }
    }
    std::vector<double> of_series{};
    double upper = 0.0;
};

class dots {
  public:
    dots(drawing& drawing, const scale& x, const scale& y, double lowest)
        : drawing_(drawing), x_(x), y_(y), lowest_(lowest) {}

    void draw(const error_series& series, double exact_y) {
        std::vector<std::array<double, 2>> places;
        for (const error_point& p : series.points)
            if (drawable(p))
                places.push_back(p.error > 0 ? free_place(x_(p.time), y_(p.error))
                                             : std::array{x_(p.time), exact_y});
        if (series.joined) drawing_.path(places, of_tone('s', series.tone), true);
        taken_.insert(taken_.end(), places.begin(), places.end());
        auto place = places.begin();
        for (const error_point& p : series.points)
            if (drawable(p)) {
                const auto [x, y] = *place++;
                drawing_.shape(
                    x, y, series.shape, of_tone('f', series.tone),
                    fmt::format("{}{}{}: {:.4g} at {:.4g}", series.name,
                                p.setting.empty() ? "" : ", ", p.setting, p.error, p.time));
            }
    }

  private:
    /// The nearest place to (x, y), on rings around it, at which no dot of another series is.
    [[nodiscard]] std::array<double, 2> free_place(double x, double y) const {
        const auto is_free = [&](const std::array<double, 2>& at) {
            return at[1] <= lowest_ && std::ranges::none_of(taken_, [&](const auto& other) {
                       return std::hypot(at[0] - other[0], at[1] - other[1]) < mark_size;
                   });
        };
        for (double reach = 0; reach <= farthest; reach += 2)
            for (int turn = 0; turn < (reach > 0 ? 16 : 1); ++turn) {
                const double angle = turn * std::acos(-1.0) / 8;
                const std::array at{x + reach * std::cos(angle), y + reach * std::sin(angle)};
                if (is_free(at)) return at;
            }
        return {x, y};
    }

    drawing& drawing_;
    const scale& x_;
    const scale& y_;
    double lowest_;  // of dots with an error
    std::vector<std::array<double, 2>> taken_{};
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
    const lanes exact(chart.series);
    const double axis_bottom = exact.upper - 14;  // where the least error is
    const scale y(std::pow(10, rows.front()), std::max(std::pow(10, rows.back()), ys.high * 1.1),
                  true, axis_bottom, top);
    drawing drawing(chart.caption);
    for (const int row : rows) {
        const double at = y(std::pow(10, row));
        drawing.line(left, at, right, at, "grid");
        drawing.text(left - 8, at + 4, power_of_ten(row), "small", "end");
    }
    drawing.upright_text(20, top + plot_height / 2, chart.error_label);
    drawing.line(left, exact.upper, right, exact.upper, "axis", true);
    drawing.text(left - 8, (exact.upper + plot_bottom) / 2 + 4, chart.exact_label, "small", "end");
    for (const double tick : x.ticks())
        drawing.text(x(tick), top + plot_height + 18, short_number(tick), "small", "middle");
    drawing.line(left, top + plot_height, right, top + plot_height, "axis");
    drawing.text((left + right) / 2, top + plot_height + 38, chart.time_label, "", "middle");
    dots dots(drawing, x, y, axis_bottom);
    for (std::size_t i = 0; i < chart.series.size(); ++i)
        dots.draw(chart.series[i], exact.of_series[i]);
    draw_names(drawing, chart.series, right);
    return drawing.finished();
}

}  // namespace treeform::bench
