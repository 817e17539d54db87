/// \file
/// F5: how the build of a tree scales with threads and with the number of primitives.

#include "bench/face_boxes.hpp"
#include "bench/page.hpp"
#include "bench/sizes.hpp"
#include <libtree/paper/nary_tree.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>

#include <fmt/core.h>

namespace treeform::bench {
namespace {

/// 1, 2, 4 and so on, and what the machine has.
std::vector<unsigned> thread_counts() {
    std::vector<unsigned> counts;
    for (unsigned count = 1; count < thread_count(); count *= 2) counts.push_back(count);
    counts.push_back(thread_count());
    return counts;
}

contest contest_of(const setting& setting, const model& model) {
    const auto given = [=] { return load(setting, model); };
    contest contest{.name = name_of(setting, model),
                    .size = [=] { return given()->faces.size(); },
                    .with_memory = false};
    for (const unsigned threads : thread_counts()) {
        contest.contestants.push_back(
            {"treeform", threads, [=] {
                 return make_job([mesh = given()] { return build(mesh->faces, face_box(*mesh)); });
             }});
        contest.contestants.push_back({"paper", threads, [=] {
                                           return make_job([mesh = given()] {
                                               return build(mesh->faces, face_box(*mesh),
                                                            tree_config{.inner_size = 4});
                                           });
                                       }});
    }
    return contest;
}

/// How much of what the threads could save they do save, in per cent.
double efficiency(const outcome& outcome, const std::string& who, unsigned threads) {
    return 100 * outcome.value(who).value_or(0) / outcome.value(who, threads).value_or(1) / threads;
}

}  // namespace

void build_by_threads(const setting& setting, const contest_visitor& visit) {
    for (const model& model : one_model_by_size(setting)) visit(contest_of(setting, model));
}

section draw_build_by_threads(const std::vector<outcome>& outcomes, const std::string& machine) {
    const outcome& largest = outcomes.back();
    const unsigned threads = largest.rows.back().threads;
    const auto rate = [&](const std::string& who) {
        return static_cast<double>(largest.size) / largest.value(who, threads).value_or(1) / 1e3;
    };
    const std::string ours = fmt::format(
        "with {} threads {} triangles keep {:.0f} % of each thread's time (the paper's layout "
        "{:.0f} "
        "%), at {:.3g} million primitives a second (the paper's layout {:.3g}).",
        threads, largest.size, efficiency(largest, "treeform", threads),
        efficiency(largest, "paper", threads), rate("treeform"), rate("paper"));
    return {.paper =
                "six threads reach an efficiency of 66 % at 18 million primitives a second, and "
                "time grows nearly linearly with their number.",
            .ours = ours,
            .pictures = {{"f5_threads.svg", svg(line_chart{{"Tree build by threads", machine},
                                                           {"triangles", false},
                                                           {"build time, ms", false},
                                                           curves_by_size(outcomes)})}}};
}

}  // namespace treeform::bench
