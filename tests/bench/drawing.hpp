#pragma once
/// \file
/// What pictures are drawn with: the text of an SVG file, places along its sides, one style. For
/// the sources of charts alone.

#include "bench/chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::bench {

inline constexpr double width = 760, left = 76, top = 80, bottom = 60;
inline constexpr double plot_height = 300;
inline constexpr double height = top + plot_height + bottom;

/// Colors by class, not by variable: some viewers know no others. A picture has paper of its own,
/// as nobody knows on what it will lie; marks have a rim of it, so that each can be told from the
/// next.
inline constexpr std::string_view style =
    "text{font:13px system-ui,'DejaVu Sans',sans-serif;fill:#24292f}"
    ".title{font-size:15px;font-weight:600}.small{font-size:11px;fill:#57606a}"
    ".grid{stroke:#d0d7de;stroke-width:1}.axis{stroke:#57606a;stroke-width:1}"
    ".paper{fill:#fff}.line{fill:none;stroke-width:2}.mark{stroke:#fff;stroke-width:1}"
    ".s1{stroke:#1f6feb}.f1{fill:#1f6feb}.s2{stroke:#bc5c00}.f2{fill:#bc5c00}"
    ".s3{stroke:#1a7f37}.f3{fill:#1a7f37}.s4{stroke:#8250df}.f4{fill:#8250df}"
    ".s5{stroke:#bf3989}.f5{fill:#bf3989}.s6{stroke:#0e7490}.f6{fill:#0e7490}"
    ".s7{stroke:#7d6400}.f7{fill:#7d6400}.s8{stroke:#57606a}.f8{fill:#57606a}"
    "@media(prefers-color-scheme:dark){.paper{fill:#0d1117}.mark{stroke:#0d1117}text{fill:#e6edf3}."
    "small{fill:#9aa4af}"
    ".grid{stroke:#30363d}.axis{stroke:#9aa4af}"
    ".s1{stroke:#58a6ff}.f1{fill:#58a6ff}.s2{stroke:#f0883e}.f2{fill:#f0883e}"
    ".s3{stroke:#3fb950}.f3{fill:#3fb950}.s4{stroke:#bc8cff}.f4{fill:#bc8cff}"
    ".s5{stroke:#f778ba}.f5{fill:#f778ba}.s6{stroke:#39c5cf}.f6{fill:#39c5cf}"
    ".s7{stroke:#d4a72c}.f7{fill:#d4a72c}.s8{stroke:#9aa4af}.f8{fill:#9aa4af}}";

[[nodiscard]] inline std::string short_number(double value) {
    const double size = std::abs(value);
    if (size >= 1e6 && size < 1e9) return fmt::format("{:.3g}M", value / 1e6);
    if (size >= 1e3 && size < 1e6) return fmt::format("{:.3g}k", value / 1e3);
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
    /// Round values within the range: 1 2 5 a decade, decades, or every few of them where they
    /// would touch; or about five steps.
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> all;
        if (logarithmic_) {
            const int first = static_cast<int>(std::floor(std::log10(low_)));
            const int last = static_cast<int>(std::ceil(std::log10(high_)));
            int every = 1;
            for (const int step : {2, 3, 5, 10, 20, 50, 100})
                if ((last - first) / every > 9) every = step;
            const bool wide = high_ / low_ > 300;
            for (int decade = first; decade <= last; ++decade)
                for (const double step : {1.0, 2.0, 5.0}) {
                    const double tick = std::pow(10, decade) * step;
                    if (decade % every == 0 && (!wide || step == 1.0) && tick >= low_ * 0.999 &&
                        tick <= high_ * 1.001)
                        all.push_back(tick);
                }
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
        out_ += fmt::format("<rect class=\"paper\" width=\"{:.0f}\" height=\"{:.0f}\"/>\n", width,
                            height);
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
    /// A mark: 0 circle, 1 square, 2 diamond, 3 triangle, 4 the same upside down, 5 cross.
    void shape(double x, double y, int kind, std::string_view classes, const std::string& tip) {
        constexpr std::array<std::string_view, 6> outlines{
            "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0",
            "M-3.6,-3.6h7.2v7.2h-7.2z",
            "M0,-5L5,0L0,5L-5,0z",
            "M0,-4.6L4.6,3.8L-4.6,3.8z",
            "M0,4.6L4.6,-3.8L-4.6,-3.8z",
            "M-1.5,-4.6h3v3.1h3.1v3h-3.1v3.1h-3v-3.1h-3.1v-3h3.1z"};
        out_ += fmt::format(
            "<path transform=\"translate({:.1f} {:.1f})\" d=\"{}\" class=\"mark {}\" "
            "><title>{}</title></path>\n",
            x, y, outlines[static_cast<std::size_t>(kind) % outlines.size()], classes,
            escaped(tip));
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
inline void spread(std::vector<double>& places) {
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

[[nodiscard]] inline std::string of_tone(char kind, int tone) {
    return fmt::format("{}{}", kind, tone);
}

}  // namespace treeform::bench
