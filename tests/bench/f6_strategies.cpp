/// \file
/// F6: selection algorithms, in the tree and in the paper's layout.

#include "bench/face_boxes.hpp"
#include "bench/models.hpp"
#include "bench/page.hpp"
#include <libtree/paper/medians.hpp>
#include <libtree/paper/nary_tree.hpp>
#include <libtree/paper/selections.hpp>
#include <treeform/tree/build.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace treeform::bench {
namespace {

template <class Strategy>
job own_build(const shared_mesh& mesh) {
    return make_job([mesh] { return build<Strategy>(mesh->faces, face_box(*mesh)); });
}

template <class Strategy>
job paper_build(const shared_mesh& mesh) {
    return make_job([mesh] {
        return build<Strategy>(mesh->faces, face_box(*mesh), tree_config{.inner_size = 4});
    });
}

constexpr std::string_view tree_suffix = "/tree", paper_suffix = "/paper_layout";

template <class Strategy>
void add(std::vector<contestant>& own, std::vector<contestant>& paper, const std::string& name,
         const std::function<shared_mesh()>& given) {
    own.push_back({"treeform " + name, 1, [=] { return own_build<Strategy>(given()); }});
    paper.push_back({"paper " + name, 1, [=] { return paper_build<Strategy>(given()); }});
}

std::vector<model> models(const setting& setting) {
    if (setting.effort == effort::tiny) return {{"", "2k", 2'000}};
    std::vector<model> all{{"clean/armadillo_29k.obj", "50k", 50'000},
                           {"open/bunny_69k.obj", "70k", 70'000},
                           {"clean/turbineblade_199k.ply", "200k", 199'000},
                           {"clean/turbineblade_199k.ply", "1M", 1'000'000}};
    if (setting.effort == effort::quick) all.resize(2);
    return all;
}

constexpr std::array names{"default",           "pdq_select",         "floyd_rivest",
                           "median_of_medians", "median_of_ninthers", "median_of_3_random",
                           "heap_select",       "nth_element"};

/// Times of all strategies as shares of that of nth_element.
bar_chart chart_of(const std::vector<outcome>& outcomes, std::string_view suffix,
                   const std::string& prefix, const caption& caption) {
    bar_chart chart{.caption = caption, .y = {"build time / that of nth_element", true}, .line = 1};
    for (std::size_t i = 0; i < names.size(); ++i)
        chart.series.push_back({names[i], {}, static_cast<int>(i) + 1});
    for (const outcome& outcome : outcomes) {
        if (!outcome.name.ends_with(suffix)) continue;
        const double base = outcome.value(prefix + " nth_element").value_or(1);
        chart.groups.push_back(
            fmt::format("{} ({:.3g} ms)", outcome.name.substr(0, outcome.name.find('/')), base));
        for (bar_series& series : chart.series) {
            const bool is_default = series.name == names[0];
            series.values.push_back(
                outcome.value(is_default ? prefix : prefix + " " + series.name).value_or(0) / base);
        }
    }
    std::erase_if(chart.series, [](const bar_series& series) {
        return std::ranges::all_of(series.values, [](double value) { return value == 0; });
    });
    return chart;
}

/// Which strategy is the fastest at each size, by name.
std::string fastest(const bar_chart& chart) {
    std::string text;
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
        const auto best = std::ranges::min_element(
            chart.series, {}, [g](const bar_series& series) { return series.values[g]; });
        text += fmt::format("{}{} on {}", g == 0 ? "" : ", ", best->name,
                            chart.groups[g].substr(0, chart.groups[g].find(' ')));
    }
    return text;
}

}  // namespace

void strategies(const setting& setting, const contest_visitor& visit) {
    for (const model& model : models(setting)) {
        const std::function<shared_mesh()> given = [=] { return load(setting, model); };
        std::vector<contestant> own{
            {"treeform", 1,
             [=] { return own_build<treeform::detail::bracketed_select>(given()); }}};
        std::vector<contestant> paper;
        add<strategy::nth_element>(own, paper, "nth_element", given);
        add<strategy::pdq_select>(own, paper, "pdq_select", given);
        add<strategy::floyd_rivest>(own, paper, "floyd_rivest", given);
        add<strategy::median_of_medians>(own, paper, "median_of_medians", given);
        add<strategy::median_of_ninthers>(own, paper, "median_of_ninthers", given);
        add<strategy::median_of_3_random>(own, paper, "median_of_3_random", given);
        add<strategy::heap_select>(own, paper, "heap_select", given);
        const auto contest_of = [&](std::string_view suffix, std::vector<contestant> contestants) {
            return contest{.name = name_of(setting, model) + std::string(suffix),
                           .size = [=] { return given()->faces.size(); },
                           .contestants = std::move(contestants),
                           .with_memory = false,
                           .long_runs = 3};
        };
        visit(contest_of(tree_suffix, std::move(own)));
        visit(contest_of(paper_suffix, std::move(paper)));
    }
}

section draw_strategies(const std::vector<outcome>& outcomes, const std::string& machine) {
    const bar_chart own = chart_of(outcomes, tree_suffix, "treeform",
                                   {"Selection algorithms in tf::tree, one thread", machine});
    const bar_chart paper =
        chart_of(outcomes, paper_suffix, "paper",
                 {"Selection algorithms in the paper's layout, one thread", machine});
    return {
        .paper =
            "nth_element, pdq_select and floyd_rivest are the fastest three on every model, "
            "nth_element most often the first.",
        .ours = fmt::format("the fastest in the paper's layout: {}; in the tree: {}. Below 1 is "
                            "faster than nth_element, whose time stands behind the model.",
                            fastest(paper), fastest(own)),
        .pictures = {{"f6_strategies_paper.svg", svg(paper)},
                     {"f6_strategies_tree.svg", svg(own)}}};
}

}  // namespace treeform::bench
