/// \file
/// E5: welding: time against pairs left within the tolerance, and against displacement.

#include "bench/accuracy.hpp"
#include "bench/peers/nanoflann_weld.hpp"
#include "bench/peers/versions.hpp"
#include "bench/weld_answers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace treeform::bench {
namespace {

constexpr const char* missed_name = "missed";
constexpr const char* moved_name = "displacement";

contest contest_of(std::size_t points, double tolerance) {
    const auto given = [=] { return cloud_with_copies(points, 30); };
    contest contest{.name = fmt::format("{:g}", tolerance),
                    .size = [=] { return points; },
                    .with_memory = false,
                    .long_runs = 3};
    using cloud = std::vector<point3>;
    const auto add = [&](const std::string& name, const auto& weld) {
        contest.contestants.push_back(
            {name, 1, [=] { return weld_job(given(), tolerance, weld); }});
    };
    add("treeform", [=](const cloud& c) { return weld_by_treeform(c, {.tolerance = tolerance}); });
    add("treeform chain", [=](const cloud& c) {
        return weld_by_treeform(c, {.tolerance = tolerance, .chain = true});
    });
    add(nanoflann_name(), [=](const cloud& c) { return nanoflann_weld(c, tolerance); });
    // Finer grids move less and join less: the same method at several settings.
    for (const double cell : {1.0, 0.5, 2.0})
        add(fmt::format("{} eps {:g}", rounding_name, cell),
            [=](const cloud& c) { return weld_by_rounding(c, cell * tolerance); });
    return contest;
}

}  // namespace

void weld_errors(const setting& setting, const contest_visitor& visit) {
    std::size_t size = 300'000;
    if (setting.effort == effort::quick) size = 50'000;
    if (setting.effort == effort::tiny) size = 1'000;
    for (const double tolerance : {1e-5, reach, 1e-3, 3e-3}) visit(contest_of(size, tolerance));
}

section draw_weld_errors(const std::vector<outcome>& outcomes, const std::string& machine) {
    const error_of missed = [](const outcome&, const measured& row) -> std::optional<double> {
        const auto pairs = figure_of(row, missed_name);
        if (!pairs) return {};
        return *pairs / std::max(1.0, figure_of(row, "kept").value_or(1));
    };
    const error_of beyond = [](const outcome& o, const measured& row) -> std::optional<double> {
        const auto moved = figure_of(row, moved_name);
        if (!moved) return {};
        const double over = *moved / std::stod(o.name) - 1;
        return over > 1e-12 ? over : 0.0;  // the measure itself is rounded
    };
    const auto chart = [&](const char* title, const char* label, const error_of& error) {
        return svg(error_chart{{title, machine},
                               "time, ms",
                               label,
                               dots_by_method(outcomes, error, joined_by::largest),
                               "none"});
    };
    return {
        .paper = "",
        .ours = fmt::format(
            "{} points, 30 % of them copies, at {} tolerances. The rule \"first\" leaves no two "
            "points within the tolerance and moves none further than it.",
            outcomes.front().size, outcomes.size()),
        .pictures = {{"e5_left.svg", chart("Welding: what is left within the tolerance",
                                           "pairs left, a kept point", missed)},
                     {"e5_moved.svg", chart("Welding: what moves further than the tolerance",
                                            "largest move beyond it, in tolerances", beyond)}},
        .table = summary_of(outcomes,
                            {{"pairs left", figure_named(missed_name)},
                             {"beyond the tolerance, at most", beyond, joined_by::largest, false}}),
        .remarks = {
            "Rounding to a grid joins what falls into one cube: two points may be as near as one "
            "likes and fall into two (pairs left), and points of one cube may be apart by its "
            "diagonal, 1.73 of its width (beyond the tolerance). Cubes of half the width never "
            "move "
            "a point beyond the tolerance and leave more pairs; cubes of twice the width leave "
            "fewer and move points further. The rule \"chain\" leaves nothing "
            "and may move a point by many tolerances, as its documentation says: that is what "
            "joining all that is linked means."}};
}

}  // namespace treeform::bench
