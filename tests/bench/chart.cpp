#include "bench/chart.hpp"

#include "bench/drawing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace treeform::bench {
namespace {

void draw_curve(drawing& drawing, const curve& curve, const scale& x, const scale& y) {
    std::vector<std::array<double, 2>> places;
    for (const auto& [px, py] : curve.points) places.push_back({x(px), y(py)});
    drawing.path(places, of_tone('s', curve.tone), curve.dashed);
    for (std::size_t i = 0; i < places.size(); ++i)
        drawing.dot(places[i][0], places[i][1], of_tone('f', curve.tone),
                    fmt::format("{}: {} at {}", curve.name, short_number(curve.points[i][1]),
                                short_number(curve.points[i][0])));
}

void draw_names(drawing& drawing, const std::vector<curve>& curves, double right, const scale& y) {
    std::vector<double> places;
    for (const curve& curve : curves)
        places.push_back(curve.points.empty() ? top : y(curve.points.back()[1]));
    spread(places);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        drawing.line(right + 8, places[i], right + 24, places[i],
                     "line " + of_tone('s', curves[i].tone), curves[i].dashed);
        drawing.text(right + 30, places[i] + 4, curves[i].name, "", "start");
    }
}

void draw_legend(drawing& drawing, const std::vector<bar_series>& all, double right) {
    double x = left, y = 38;
    for (const bar_series& series : all) {
        const double space = 28 + 6.5 * static_cast<double>(series.name.size());
        if (x + space > right) x = left, y += 17;
        drawing.box(x, y, 11, 11, of_tone('f', series.tone), 1, series.name);
        drawing.text(x + 16, y + 10, series.name, "small", "start");
        x += space;
    }
}

/// The bars of group `g`, side by side about `middle`.
void draw_group(drawing& drawing, const bar_chart& chart, std::size_t g, double middle,
                double space, const scale& y) {
    // On a logarithmic axis there is no zero to stand on: bars start where the comparison is.
    const double foot = chart.y.logarithmic && chart.line > 0 ? y(chart.line) : top + plot_height;
    const auto count = static_cast<double>(chart.series.size());
    const double bar = std::min(34.0, space * 0.84 / count);
    double at = middle - bar * count / 2;
    for (const bar_series& series : chart.series) {
        const double value = series.values.at(g);
        if (value > 0) {
            const double upper = std::min(y(value), foot);
            drawing.box(
                at + 1, upper, bar - 2, std::max(y(value), foot) - upper, of_tone('f', series.tone),
                1, fmt::format("{}, {}: {}", chart.groups[g], series.name, short_number(value)));
            if (bar >= 26)
                drawing.text(at + bar / 2, upper - 4, short_number(value), "small", "middle");
        }
        at += bar;
    }
}

}  // namespace

int tone_of(std::string_view who, std::size_t otherwise) {
    constexpr std::pair<std::string_view, int> known[]{
        {"treeform", 1}, {"paper", 2},       {"CGAL", 3},   {"FCL", 4},         {"nanoflann", 5},
        {"float", 6},    {"naive float", 6}, {"double", 7}, {"naive double", 7}};
    for (const auto& [name, tone] : known)
        if (who.starts_with(name)) return tone;
    return static_cast<int>(otherwise % 8) + 1;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

std::string svg(const line_chart& chart) {
    std::size_t longest = 0;
    range xs, ys;
    for (const curve& curve : chart.curves) {
        longest = std::max(longest, curve.name.size());
        for (const auto& [x, y] : curve.points) {
            xs.include(x);
            ys.include(y);
        }
    }
    const double right = width - 44 - 7.6 * static_cast<double>(longest);
    const scale x(xs.low, xs.high, chart.x.logarithmic, left, right);
    const scale y(chart.y.logarithmic ? ys.low * 0.9 : 0, ys.high * 1.05, chart.y.logarithmic,
                  top + plot_height, top);
    drawing drawing(chart.caption);
    drawing.y_axis(y, chart.y, right);
    for (const double tick : x.ticks())
        drawing.text(x(tick), top + plot_height + 18, short_number(tick), "small", "middle");
    drawing.line(left, top + plot_height, right, top + plot_height, "axis");
    drawing.text((left + right) / 2, top + plot_height + 38, chart.x.label, "", "middle");
    for (const curve& curve : chart.curves) draw_curve(drawing, curve, x, y);
    draw_names(drawing, chart.curves, right, y);
    return drawing.finished();
}

std::string svg(const bar_chart& chart) {
    range ys;
    for (const bar_series& series : chart.series)
        for (const double value : series.values)
            if (value > 0) ys.include(value);
    if (chart.line > 0) ys.include(chart.line);
    const double right = width - 16;
    const scale y(chart.y.logarithmic ? ys.low * 0.8 : 0, ys.high * 1.05, chart.y.logarithmic,
                  top + plot_height, top);
    drawing drawing(chart.caption);
    draw_legend(drawing, chart.series, right);
    drawing.y_axis(y, chart.y, right);
    const double group = (right - left) / static_cast<double>(chart.groups.size());
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
        const double middle = left + (static_cast<double>(g) + 0.5) * group;
        draw_group(drawing, chart, g, middle, group, y);
        drawing.text(middle, top + plot_height + 18, chart.groups[g], "small", "middle");
    }
    if (chart.line > 0)
        drawing.line(left, y(chart.line), right, y(chart.line), "axis", !chart.y.logarithmic);
    drawing.line(left, top + plot_height, right, top + plot_height, "axis");
    return drawing.finished();
}

std::string svg(const heat_map& chart) {
    range values;
    for (const auto& row : chart.values)
        for (const double value : row)
            if (value > 0) values.include(std::abs(std::log(value)));
    drawing drawing(chart.caption);
    const double cell_w =
        (width - 16 - left) / static_cast<double>(std::max<std::size_t>(chart.columns.size(), 1));
    const double cell_h =
        plot_height / static_cast<double>(std::max<std::size_t>(chart.rows.size(), 1));
    for (std::size_t r = 0; r < chart.rows.size(); ++r) {
        const double y = top + static_cast<double>(r) * cell_h;
        drawing.text(left - 8, y + cell_h / 2 + 4, chart.rows[r], "small", "end");
        for (std::size_t c = 0; c < chart.columns.size(); ++c) {
            const double value = chart.values.at(r).at(c);
            if (!(value > 0)) continue;
            // Never so strong that the text on it, in the color of the page's text, is hard to
            // read.
            const double strength =
                values.high > 0 ? 0.08 + 0.47 * std::abs(std::log(value)) / values.high : 0.08;
            const double x = left + static_cast<double>(c) * cell_w;
            drawing.box(x + 1, y + 1, cell_w - 2, cell_h - 2, value >= 1 ? "f1" : "f2", strength,
                        fmt::format("{} {}, {} {}: {:.3g}", chart.x_label, chart.columns[c],
                                    chart.y_label, chart.rows[r], value));
            drawing.text(x + cell_w / 2, y + cell_h / 2 + 4, fmt::format("{:.2f}", value), "",
                         "middle");
        }
    }
    for (std::size_t c = 0; c < chart.columns.size(); ++c)
        drawing.text(left + (static_cast<double>(c) + 0.5) * cell_w, top + plot_height + 18,
                     chart.columns[c], "small", "middle");
    drawing.text((left + width - 16) / 2, top + plot_height + 38, chart.x_label, "", "middle");
    drawing.upright_text(20, top + plot_height / 2, chart.y_label);
    return drawing.finished();
}

}  // namespace treeform::bench
