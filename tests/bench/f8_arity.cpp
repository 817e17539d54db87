/// \file
/// F8: the paper's sorted stack against a heap, for the distance of two models, by arity and leaf
/// size of the paper's layout.

#include "bench/page.hpp"
#include "bench/pose_askers.hpp"
#include "bench/poses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

namespace treeform::bench {
namespace {

struct shapes {
    std::vector<unsigned> arities;
    std::vector<unsigned> leaf_sizes;
};

shapes shapes_for(effort effort) {
    if (effort == effort::tiny) return {{2, 16}, {1, 4}};
    if (effort == effort::quick) return {{2, 4, 8, 16}, {2, 4, 8}};
    return {{2, 3, 4, 6, 8, 12, 16}, {1, 2, 4, 8, 16}};
}

scene_name scene_for(effort effort) {
    if (effort == effort::tiny) return {{"", "2k", 2'000}, {"", "3k", 3'000}, 3};
    return {{"clean/armadillo_29k.obj", "50k", 50'000},
            {"open/bunny_69k.obj", "70k", 70'000},
            effort == effort::quick ? 10U : 40U};
}

constexpr const char* top_k = "paper top_k";
constexpr const char* heap = "paper heap";

contest contest_of(const setting& setting, const scene_name& name, const tree_config& config,
                   const std::function<pose_answers()>& expected) {
    contest contest{.name = fmt::format("{}/arity_{}/leaf_{}", name_of(setting, name),
                                        config.inner_size, config.leaf_size),
                    .size = [=] { return triangles_of(setting, name); },
                    .unit = per_pose(name.poses),
                    .with_memory = false,
                    .long_runs = 3};
    for (const auto& [who, order] : {std::pair{top_k, open_by::top_k}, {heap, open_by::heap}})
        contest.contestants.push_back(
            {who, 1, [=, order = order] {
                 return pose_job(
                     load(setting, name), pose_question::distance,
                     [=](const scene& scene) { return paper_distance(scene, order, config); },
                     expected);
             }});
    return contest;
}

}  // namespace

void arities(const setting& setting, const contest_visitor& visit) {
    const scene_name name = scene_for(setting.effort);
    const shapes shapes = shapes_for(setting.effort);
    const shared_scene kept = load(setting, name);  // for all shapes
    const auto expected =
        answered_once([=] { return load(setting, name); }, pose_question::distance, own_distance);
    for (const unsigned leaf_size : shapes.leaf_sizes)
        for (const unsigned arity : shapes.arities)
            visit(contest_of(setting, name, {arity, leaf_size}, expected));
}

section draw_arities(const std::vector<outcome>& outcomes, const std::string& machine) {
    heat_map map{.caption = {"Time of the heap / time of the sorted stack, nearest points of two "
                             "models",
                             machine},
                 .x_label = "arity",
                 .y_label = "leaf size"};
    std::string best;
    double fastest = 0;
    for (const outcome& outcome : outcomes) {
        const std::size_t leaf = outcome.name.rfind('_') + 1;
        const std::size_t arity = outcome.name.find("/arity_") + 7;
        const std::string column = outcome.name.substr(arity, outcome.name.rfind('/') - arity);
        const std::string row = outcome.name.substr(leaf);
        if (std::ranges::find(map.columns, column) == map.columns.end())
            map.columns.push_back(column);
        if (map.rows.empty() || map.rows.back() != row) {
            map.rows.push_back(row);
            map.values.emplace_back();
        }
        const double of_stack = outcome.value(top_k).value_or(1);
        map.values.back().push_back(outcome.value(heap).value_or(1) / of_stack);
        if (best.empty() || of_stack < fastest) {
            fastest = of_stack;
            best = fmt::format("arity {} with leaves of {} at {:.4g} us a position", column, row,
                               of_stack);
        }
    }
    const auto mean = [&](std::size_t column) {
        double sum = 0;
        for (const auto& row : map.values) sum += row[column];
        return sum / static_cast<double>(map.values.size());
    };
    return {.paper = "the advantage of the sorted stack grows with the arity.",
            .ours = fmt::format("the heap takes {:.2f} times as long as the stack at arity {} and "
                                "{:.2f} times at arity {}, in the mean of the leaf sizes; the "
                                "fastest stack is that of {}.",
                                mean(0), map.columns.front(), mean(map.columns.size() - 1),
                                map.columns.back(), best),
            .pictures = {{"f8_arity.svg", svg(map)}}};
}

}  // namespace treeform::bench
