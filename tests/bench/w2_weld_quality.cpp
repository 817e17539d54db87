/// \file
/// W2: what welding takes, and what it leaves and moves, over the tolerance and the rule.

#include "bench/page.hpp"
#include "bench/peers/nanoflann_weld.hpp"
#include "bench/peers/versions.hpp"
#include "bench/weld_answers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace treeform::bench {
namespace {

constexpr const char* chain_name = "treeform rule chain";

contest contest_of(std::size_t points, double tolerance) {
    const auto given = [=] { return cloud_with_copies(points, 30); };
    contest contest{.name = fmt::format("tolerance/{:g}", tolerance),
                    .size = [=] { return points; },
                    .with_memory = false,
                    .long_runs = 3};
    const auto add = [&](const std::string& name, const auto& weld) {
        contest.contestants.push_back(
            {name, 1, [=] { return weld_job(given(), tolerance, weld); }});
    };
    using cloud = std::vector<point3>;
    add("treeform", [=](const cloud& c) { return weld_by_treeform(c, {.tolerance = tolerance}); });
    add(chain_name, [=](const cloud& c) {
        return weld_by_treeform(c, {.tolerance = tolerance, .chain = true});
    });
    add(nanoflann_name(), [=](const cloud& c) { return nanoflann_weld(c, tolerance); });
    add(rounding_name, [=](const cloud& c) { return weld_by_rounding(c, tolerance); });
    return contest;
}

double tolerance_of(const outcome& outcome) {
    return std::stod(outcome.name.substr(outcome.name.find('/') + 1));
}

/// A curve of each contestant over the tolerance.
template <class Value>
std::vector<curve> curves_by_tolerance(const std::vector<outcome>& outcomes, const Value& value) {
    std::vector<curve> curves;
    for (const outcome& outcome : outcomes)
        for (std::size_t who = 0; who < outcome.rows.size(); ++who) {
            const std::string& name = outcome.rows[who].who;
            if (curves.size() <= who) curves.push_back({name, {}, tone_of(name, who + 1)});
            curves[who].points.push_back({tolerance_of(outcome), value(outcome, name)});
        }
    return curves;
}

}  // namespace

void weld_quality_by_tolerance(const setting& setting, const contest_visitor& visit) {
    std::size_t size = 1'000'000;
    if (setting.effort == effort::quick) size = 100'000;
    if (setting.effort == effort::tiny) size = 1'000;
    for (const double tolerance : {1e-6, 1e-5, 3e-5, reach, 3e-4, 1e-3, 3e-3, 1e-2})
        visit(contest_of(size, tolerance));
}

section draw_weld_quality(const std::vector<outcome>& outcomes, const std::string& machine) {
    const auto chart = [&](const std::string& title, const axis& y, const auto& value) {
        line_chart lines;
        lines.caption = {title, machine};
        lines.x = {"tolerance", true};
        lines.y = y;
        lines.curves = curves_by_tolerance(outcomes, value);
        return svg(lines);
    };
    const std::string peer = nanoflann_name();
    const auto at_reach = std::ranges::find_if(
        outcomes, [](const outcome& o) { return tolerance_of(o) > 0.99 * reach; });
    const auto of_rounding = [&](const char* what) {
        return at_reach->figure(rounding_name, what).value_or(0);
    };
    return {
        .paper = "",
        .ours = fmt::format(
            "{} points, 30 % of them copies moved by the tolerance: {}, {} for the same answer; "
            "rounding to a grid leaves {:.0f} pairs within the tolerance.",
            at_reach->size,
            compared(at_reach->value("treeform").value_or(0), at_reach->value(peer).value_or(0)),
            peer, of_rounding("missed")),
        .pictures = {
            {"w2_time.svg", chart("Welding, one thread", {"time, ms", true},
                                  [](const outcome& o, const std::string& who) {
                                      return o.value(who).value_or(0);
                                  })},
            {"w2_missed.svg",
             chart("Pairs left within the tolerance", {"of the kept points, per cent", false},
                   [](const outcome& o, const std::string& who) {
                       return 100 * o.figure(who, "missed").value_or(0) /
                              std::max(1.0, o.figure(who, "kept").value_or(1));
                   })},
            {"w2_displacement.svg", chart("Largest displacement", {"in tolerances", true},
                                          [](const outcome& o, const std::string& who) {
                                              // Nothing moved: the chart's axis is logarithmic.
                                              return std::max(
                                                  1e-3, o.figure(who, "displacement").value_or(0) /
                                                            tolerance_of(o));
                                          })}}};
}

}  // namespace treeform::bench
