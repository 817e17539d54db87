/// \file
/// B3: all pairs of points of a cloud within reach of each other, from arrays, tree included.

#include "bench/near_pairs.hpp"
#include "bench/page.hpp"
#include "bench/peers/nanoflann_points.hpp"
#include "bench/peers/versions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace treeform::bench {
namespace {

/// Sorting along one axis is quadratic in the end, and nanoflann takes half a minute for more.
constexpr std::size_t most_counted = 1'000'000;

std::optional<double> error_of(std::size_t count, const std::vector<point3>& points) {
    if (points.size() > most_counted) return {};
    return std::abs(static_cast<double>(count) - static_cast<double>(near_pair_count(points)));
}

template <class MakeTree>
job whole_job(const shared_cloud& cloud, MakeTree make_tree) {
    return make_job([=] { return near_pairs(make_tree(*cloud), *cloud); },
                    [cloud](const pair_lists& lists) { return error_of(count_of(lists), *cloud); });
}

contest contest_of(std::size_t points, unsigned percent) {
    const auto given = [=] { return cloud_with_copies(points, percent); };
    contest contest{.name = fmt::format("{}_points/{}%", points, percent),
                    .size = [=] { return points; },
                    .long_runs = 3};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"treeform", threads, [=] { return whole_job(given(), reach_tree); }});
    for (const unsigned threads : {1U, 2U})
        if (threads == 2 || points <= most_counted)
            contest.contestants.push_back(
                {"paper", threads, [=] { return whole_job(given(), paper_point_tree); }});
    if (points > most_counted) return contest;  // the rest would take minutes
    contest.contestants.push_back({nanoflann_name(), 1, [=] {
                                       return make_job([cloud = given()] {
                                           return nanoflann_tree(*cloud).pairs_within(reach);
                                       });
                                   }});
    return contest;
}

}  // namespace

void near_pairs_from_arrays(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> sizes{100'000, 500'000, 1'000'000, 10'000'000};
    if (setting.effort == effort::quick) sizes = {100'000, 250'000};
    if (setting.effort == effort::tiny) sizes = {1'000};
    for (const std::size_t size : sizes) visit(contest_of(size, 30));
}

section draw_near_pairs_from_arrays(const std::vector<outcome>& outcomes,
                                    const std::string& machine) {
    // The largest that all of them were asked.
    const outcome& last = *std::find_if(outcomes.rbegin(), outcomes.rend(), [](const outcome& o) {
        return o.value(nanoflann_name()).has_value();
    });
    const double own = last.value("treeform").value_or(0);
    return {.paper = "",
            .ours = fmt::format("{} points, tree included: {:.3g} ms on one thread, {:.3g} ms on "
                                "two; {} {}, on one thread.",
                                last.size, own, last.value("treeform", 2).value_or(0),
                                compared(own, last.value(nanoflann_name()).value_or(0)),
                                nanoflann_name()),
            .pictures = {{"b3_near_pairs.svg",
                          svg(line_chart{{"Tree and all pairs within reach, 30 % copies", machine},
                                         {"points", true},
                                         {"time, ms", true},
                                         curves_by_size(outcomes)})}}};
}

}  // namespace treeform::bench
