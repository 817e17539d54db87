/// \file
/// F7: all pairs of points of a cloud within reach of each other, trees given.

#include "bench/near_pairs.hpp"
#include "bench/page.hpp"
#include "bench/peers/nanoflann_points.hpp"
#include "bench/peers/versions.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace treeform::bench {
namespace {

using truth = std::function<double()>;

truth counted_once(const std::function<shared_cloud()>& given) {
    const auto known = std::make_shared<std::optional<double>>();
    return [=] {
        if (!*known) *known = static_cast<double>(near_pair_count(*given()));
        return **known;
    };
}

/// Times `near_pairs` with the tree that `make_tree` makes.
template <class MakeTree>
job query_job(const shared_cloud& cloud, const truth& expected, MakeTree make_tree) {
    using tree_type = decltype(make_tree(*cloud));
    const auto tree = std::make_shared<const tree_type>(make_tree(*cloud));
    return make_job([cloud, tree] { return near_pairs(*tree, *cloud); },
                    [expected](const pair_lists& lists) {
                        return std::abs(static_cast<double>(count_of(lists)) - expected());
                    },
                    [](const pair_lists& lists) {
                        return std::vector<figure>{{"pairs", static_cast<double>(count_of(lists))}};
                    });
}

contest contest_of(std::size_t points, unsigned percent) {
    const std::function<shared_cloud()> given = [=] { return cloud_with_copies(points, percent); };
    const truth expected = counted_once(given);
    contest contest{.name = fmt::format("{}_points/{}%", points, percent),
                    .size = [=] { return points; },
                    .with_memory = false,
                    .long_runs = 3};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"treeform", threads, [=] { return query_job(given(), expected, reach_tree); }});
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back(
            {"paper", threads, [=] { return query_job(given(), expected, paper_point_tree); }});
    contest.contestants.push_back(
        {nanoflann_name(), 1, [=] {
             const shared_cloud cloud = given();
             const auto tree = std::make_shared<const nanoflann_tree>(*cloud);
             return make_job([cloud, tree] { return tree->pairs_within(reach); },
                             [expected](std::size_t count) {
                                 return std::abs(static_cast<double>(count) - expected());
                             });
         }});
    return contest;
}

constexpr std::array percents{10U, 30U, 50U};

double percent_of(const outcome& outcome) {
    return std::stod(outcome.name.substr(outcome.name.find('/') + 1));
}

}  // namespace

void near_pairs_given_trees(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> sizes{100'000, 250'000, 500'000, 1'000'000};
    if (setting.effort == effort::quick) sizes = {100'000, 250'000};
    if (setting.effort == effort::tiny) sizes = {1'000};
    for (const std::size_t size : sizes)
        for (const unsigned percent : percents) visit(contest_of(size, percent));
}

section draw_near_pairs(const std::vector<outcome>& outcomes, const std::string& machine) {
    std::vector<curve> curves;
    const auto add = [&](const outcome& outcome, const std::string& who, int tone, bool dashed) {
        const std::string name =
            fmt::format("{} {:.4g}M", who, static_cast<double>(outcome.size) / 1e6);
        if (curves.empty() || std::ranges::find(curves, name, &curve::name) == curves.end())
            curves.push_back({name, {}, tone, dashed});
        std::ranges::find(curves, name, &curve::name)
            ->points.push_back({percent_of(outcome), outcome.value(who).value_or(0)});
    };
    const std::string peer = nanoflann_name();
    for (const outcome& outcome : outcomes) {
        add(outcome, "treeform", 1, false);
        add(outcome, "paper", 2, false);
        add(outcome, peer, 5, false);
    }
    const outcome& last = outcomes.back();
    const double own = last.value("treeform").value_or(0);
    const std::string ours = fmt::format(
        "{} points of which half are copies take {:.3g} ms on one thread, {:.3g} ms on two; {} the "
        "paper's layout and search and {} {}, on one thread.",
        last.size, own, last.value("treeform", 2).value_or(0),
        compared(own, last.value("paper").value_or(0)), compared(own, last.value(peer).value_or(0)),
        peer);
    return {
        .paper = "self-queries stay interactive at all sizes and shares of copies (six threads).",
        .ours = ours,
        .pictures = {{"f7_near_pairs.svg",
                      svg(line_chart{{"All pairs within reach of each other, one thread", machine},
                                     {"points that are copies, per cent", false},
                                     {"query time, ms", true},
                                     curves})}}};
}

}  // namespace treeform::bench
