#include "bench/page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace treeform::bench {
namespace {

constexpr std::string_view head =
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width\">\n"
    "<title>treeform beside the paper and its peers</title>\n<style>\n"
    ":root{color-scheme:light dark}\n"
    "body{font:16px/1.5 system-ui,sans-serif;max-width:800px;margin:2rem auto;padding:0 1rem;"
    "color:#24292f;background:#fff}\n"
    "svg{max-width:100%;height:auto}table{border-collapse:collapse;font-size:14px}\n"
    ".wide{overflow-x:auto}td,th{padding:.2rem .7rem;text-align:right;"
    "border-bottom:1px solid #d0d7de;white-space:nowrap}\n"
    "td:first-child,th:first-child{text-align:left}.from{color:#57606a}\n"
    "@media(prefers-color-scheme:dark){body{color:#e6edf3;background:#0d1117}"
    "td,th{border-color:#30363d}.from{color:#9aa4af}}\n"
    "</style></head><body>\n";

std::string html_table(const std::vector<std::vector<std::string>>& table) {
    std::string text = "<div class=\"wide\"><table>\n";
    for (std::size_t row = 0; row < table.size(); ++row) {
        text += "<tr>";
        for (const std::string& cell : table[row])
            text += fmt::format("<{0}>{1}</{0}>", row == 0 ? "th" : "td", escaped(cell));
        text += "</tr>\n";
    }
    return text + "</table></div>\n";
}

/// A series without values for each contestant; who has a color of his own gets it first.
std::vector<bar_series> series_of(const std::vector<measured>& rows) {
    std::array<bool, 9> used{};
    std::vector<bar_series> all;
    for (const measured& row : rows) {
        const int tone = tone_of(row.who);
        const bool free = !std::exchange(used.at(static_cast<std::size_t>(tone)), true);
        all.push_back(
            {row.threads > 1 ? fmt::format("{}, {} threads", row.who, row.threads) : row.who,
             {},
             free ? tone : 0});
    }
    for (bar_series& series : all) {
        if (series.tone != 0) continue;
        const auto next = std::find(used.begin() + 1, used.end(), false);
        series.tone = next == used.end() ? 8 : static_cast<int>(next - used.begin());
        if (next != used.end()) *next = true;
    }
    return all;
}

void write_file(const std::string& path, std::string_view text) {
    std::ofstream file(path);
    if (!(file << text << std::flush)) throw std::runtime_error("cannot write " + path);
}

}  // namespace

std::optional<double> outcome::value(const std::string& who, unsigned threads) const {
    for (const measured& row : rows)
        if (row.who == who && row.threads == threads)
            return unit.is_rate ? unit.scale / row.median : unit.scale * row.median;
    return {};
}

std::optional<double> outcome::figure(const std::string& who, const std::string& of) const {
    for (const measured& row : rows)
        if (row.who == who)
            for (const bench::figure& figure : row.figures)
                if (figure.unit == of) return figure.value;
    return {};
}

void page::add(const workload& workload, const std::vector<outcome>& outcomes) {
    if (!workload.draw || outcomes.empty()) return;
    section section = workload.draw(outcomes, machine_);
    body_ += fmt::format("<h2 id=\"{0}\">{0}: {1}</h2>\n", workload.id, escaped(workload.title));
    if (!section.paper.empty())
        body_ += fmt::format("<p class=\"from\">The paper: {}</p>\n", escaped(section.paper));
    body_ += fmt::format("<p>Here: {}</p>\n", escaped(section.ours));
    for (picture& picture : section.pictures) {
        body_ += picture.svg;
        pictures_.push_back(std::move(picture));
    }
    if (!section.table.empty()) body_ += html_table(section.table);
    for (const std::string& remark : section.remarks)
        body_ += fmt::format("<p>{}</p>\n", escaped(remark));
}

void page::write(const std::string& folder) const {
    if (body_.empty()) return;
    for (const picture& picture : pictures_) write_file(folder + "/" + picture.file, picture.svg);
    const std::string about = fmt::format(
        "<h1>treeform beside the paper and its peers</h1>\n<p>Measured on {}. Figures are medians "
        "of runs that took turns; all of them are in <a href=\"bench.csv\">bench.csv</a>, the "
        "machine in <a href=\"machine.txt\">machine.txt</a>. The paper is Sajovic, Knez and Korez, "
        "<i>tf::tree</i>; its own figures come from an Intel i7-9750H with six cores. &ldquo;paper"
        "&rdquo; is its layout and its searches, written anew here and run on this machine.</p>\n",
        escaped(machine_));
    write_file(folder + "/index.html", std::string(head) + about + body_ + "</body></html>\n");
}

std::string compared(double own, double other) {
    return own <= other ? fmt::format("{:.1f} times as fast as", other / own)
                        : fmt::format("{:.1f} times as slow as", own / other);
}

bar_chart bars_by_contest(std::span<const outcome> outcomes, const std::string& suffix,
                          const caption& caption, const std::string& base) {
    bar_chart chart{.caption = caption, .y = {}};
    for (const outcome& outcome : outcomes) {
        if (!outcome.name.ends_with(suffix)) continue;
        if (chart.series.empty()) chart.series = series_of(outcome.rows);
        chart.y.label = outcome.unit.name;
        std::string group = outcome.name.substr(0, outcome.name.size() - suffix.size());
        double scale = 1;
        if (!base.empty()) {
            const double of_base = outcome.value(base).value_or(1);
            group += fmt::format(" ({:.3g} {})", of_base, outcome.unit.name);
            scale = 1 / of_base;
        }
        chart.groups.push_back(std::move(group));
        for (std::size_t i = 0; i < chart.series.size(); ++i) {
            const measured& row = outcome.rows.at(i);
            chart.series[i].values.push_back(scale * *outcome.value(row.who, row.threads));
        }
    }
    if (!base.empty()) {
        chart.y = {"time / that of " + base, true};
        chart.line = 1;
    }
    return chart;
}

std::vector<curve> curves_by_size(std::span<const outcome> outcomes) {
    std::vector<curve> curves;
    const auto several = [&](const std::string& who) {
        for (const outcome& outcome : outcomes)
            for (const measured& row : outcome.rows)
                if (row.who == who && row.threads > 1) return true;
        return false;
    };
    for (const outcome& outcome : outcomes)
        for (const measured& row : outcome.rows) {
            const std::string name =
                several(row.who) ? fmt::format("{}, {} thr", row.who, row.threads) : row.who;
            auto found = std::ranges::find(curves, name, &curve::name);
            if (found == curves.end()) {
                curves.push_back({name,
                                  {},
                                  tone_of(row.who, curves.size()),
                                  row.threads == 1 && several(row.who)});
                found = std::prev(curves.end());
            }
            found->points.push_back(
                {static_cast<double>(outcome.size), *outcome.value(row.who, row.threads)});
        }
    for (curve& curve : curves) std::ranges::sort(curve.points);
    // What would look the same except for its name gets dashes.
    for (std::size_t i = 0; i < curves.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (curves[i].tone == curves[j].tone && curves[i].dashed == curves[j].dashed)
                curves[i].dashed = true;
    return curves;
}

}  // namespace treeform::bench
