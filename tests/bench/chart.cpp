#include "bench/chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tf::bench {
namespace {

constexpr double width = 760, left = 76, top = 80, bottom = 60;
constexpr double plot_height = 300;
constexpr double height = top + plot_height + bottom;

/// Colours by class, not by variable: some viewers know no others.
constexpr std::string_view style =
    "text{font:13px system-ui,'DejaVu Sans',sans-serif;fill:#24292f}"
    ".title{font-size:15px;font-weight:600}.small{font-size:11px;fill:#57606a}"
    ".grid{stroke:#d0d7de;stroke-width:1}.axis{stroke:#57606a;stroke-width:1}"
    ".line{fill:none;stroke-width:2}.mark{stroke:none}"
    ".s1{stroke:#1f6feb}.f1{fill:#1f6feb}.s2{stroke:#bc5c00}.f2{fill:#bc5c00}"
    ".s3{stroke:#1a7f37}.f3{fill:#1a7f37}.s4{stroke:#8250df}.f4{fill:#8250df}"
    ".s5{stroke:#bf3989}.f5{fill:#bf3989}.s6{stroke:#0e7490}.f6{fill:#0e7490}"
    ".s7{stroke:#7d6400}.f7{fill:#7d6400}.s8{stroke:#57606a}.f8{fill:#57606a}"
    "@media(prefers-color-scheme:dark){text{fill:#e6edf3}.small{fill:#9aa4af}"
    ".grid{stroke:#30363d}.axis{stroke:#9aa4af}"
    ".s1{stroke:#58a6ff}.f1{fill:#58a6ff}.s2{stroke:#f0883e}.f2{fill:#f0883e}"
    ".s3{stroke:#3fb950}.f3{fill:#3fb950}.s4{stroke:#bc8cff}.f4{fill:#bc8cff}"
    ".s5{stroke:#f778ba}.f5{fill:#f778ba}.s6{stroke:#39c5cf}.f6{fill:#39c5cf}"
    ".s7{stroke:#d4a72c}.f7{fill:#d4a72c}.s8{stroke:#9aa4af}.f8{fill:#9aa4af}}";

std::string short_number(double value) {
    const double size = std::abs(value);
    if (size >= 1e6) return fmt::format("{:.3g}M", value / 1e6);
    if (size >= 1e3) return fmt::format("{:.3g}k", value / 1e3);
    return fmt::format("{:.3g}", value);
}

/// From values to places along one side of the plot.
class scale {
  public:
    scale(double low, double high, bool logarithmic, double from, double to)
        : logarithmic_(logarithmic), from_(from), to_(to) {
        if (!(low < high)) low = low > 0 ? low / 2 : 0, high = low > 0 ? low * 4 : 1;
        low_ = low;
        high_ = high;
    }
    [[nodiscard]] double operator()(double value) const {
        const auto measure = [&](double x) { return logarithmic_ ? std::log10(x) : x; };
        const double share = (measure(value) - measure(low_)) / (measure(high_) - measure(low_));
        return from_ + share * (to_ - from_);
    }
    /// Round values within the range: 1 2 5 a decade, or about five steps.
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> all;
        if (logarithmic_) {
            const bool wide = high_ / low_ > 300;
            for (double decade = std::pow(10, std::floor(std::log10(low_))); decade <= high_;
                 decade *= 10)
                for (const double step : {1.0, 2.0, 5.0})
                    if ((!wide || step == 1.0) && decade * step >= low_ * 0.999 &&
                        decade * step <= high_ * 1.001)
                        all.push_back(decade * step);
        } else {
            const double rough = (high_ - low_) / 5;
            const double decade = std::pow(10, std::floor(std::log10(rough)));
            double step = decade * 10;
            for (const double factor : {5.0, 2.0, 1.0})
                if (decade * factor >= rough) step = decade * factor;
            for (double i = std::ceil(low_ / step); i * step <= high_ * 1.0001; ++i)
                all.push_back(i * step);
        }
        return all;
    }

  private:
    bool logarithmic_;
    double from_, to_, low_ = 0, high_ = 1;
};

class drawing {
  public:
    explicit drawing(const caption& caption) {
        out_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
            "width=\"{:.0f}\" height=\"{:.0f}\" role=\"img\"><style>{}</style>\n",
            width, height, width, height, style);
        text(left, 22, caption.title, "title", "start");
        text(width - 12, height - 8, caption.machine, "small", "end");
    }
    void line(double x0, double y0, double x1, double y1, std::string_view classes,
              bool dashed = false) {
        out_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" ", x0,
                            y0, x1, y1);
        out_ +=
            fmt::format("class=\"{}\"{}/>\n", classes, dashed ? " stroke-dasharray=\"6 4\"" : "");
    }
    void text(double x, double y, std::string_view words, std::string_view classes,
              std::string_view anchor) {
        out_ += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n", x, y,
            classes, anchor, escaped(words));
    }
    void upright_text(double x, double y, std::string_view words) {
        out_ += fmt::format(
            "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" "
            "text-anchor=\"middle\">{}</text>\n",
            x, y, escaped(words));
    }
    void box(double x, double y, double w, double h, std::string_view classes, double opacity,
             const std::string& tip) {
        out_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" ",
                            x, y, w, h);
        out_ += fmt::format(
            "rx=\"1.5\" class=\"{}\" fill-opacity=\"{:.2f}\"><title>{}</title>"
            "</rect>\n",
            classes, opacity, escaped(tip));
    }
    void dot(double x, double y, std::string_view classes, const std::string& tip) {
        out_ += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" class=\"mark {}\">"
            "<title>{}</title></circle>\n",
            x, y, classes, escaped(tip));
    }
    void path(const std::vector<std::array<double, 2>>& points, std::string_view classes,
              bool dashed) {
        out_ += "<polyline points=\"";
        for (const auto& [x, y] : points) out_ += fmt::format("{:.1f},{:.1f} ", x, y);
        out_ += fmt::format("\" class=\"line {}\"{}/>\n", classes,
                            dashed ? " stroke-dasharray=\"6 4\"" : "");
    }
    /// The vertical axis with its lines across the plot.
    void y_axis(const scale& y, const axis& axis, double right) {
        for (const double tick : y.ticks()) {
            line(left, y(tick), right, y(tick), "grid");
            text(left - 8, y(tick) + 4, short_number(tick), "small", "end");
        }
        upright_text(20, top + plot_height / 2, axis.label);
    }
    [[nodiscard]] std::string finished() { return std::move(out_) + "</svg>\n"; }

  private:
    std::string out_;
};

struct range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Moves labels apart that would lie on each other; keeps their order.
void spread(std::vector<double>& places) {
    std::vector<std::size_t> order(places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    constexpr double line_height = 16;
    for (std::size_t i = 1; i < order.size(); ++i)
        places[order[i]] = std::max(places[order[i]], places[order[i - 1]] + line_height);
    double limit = top + plot_height + 6;
    for (std::size_t i = order.size(); i-- > 0; limit -= line_height)
        places[order[i]] = std::min(places[order[i]], limit);
}

std::string of_tone(char kind, int tone) { return fmt::format("{}{}", kind, tone); }

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
        {"treeform", 1}, {"paper", 2}, {"CGAL", 3}, {"FCL", 4}, {"nanoflann", 5}};
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
            // Never so strong that the text on it, in the colour of the page's text, is hard to
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

}  // namespace tf::bench
