/// \file
/// C1: the union of solids that hide each other. The result has about the same number of faces
/// whatever their number.

#include "bench/crowd_contest.hpp"
#include "bench/models.hpp"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <vector>

namespace treeform::bench {
namespace {

std::vector<std::size_t> sphere_counts(effort effort) {
    if (effort == effort::tiny) return {3, 6};
    if (effort == effort::quick) return {125, 500};
    return {125, 500, 2000};
}

/// Of the models that are there.
crowd copies_of_models(const setting& setting, std::size_t count) {
    return crowd_of([=] {
        meshes models;
        for (const char* path :
             {"selfint/cow_6k.obj", "clean/spot_23k.obj", "clean/fertility_9k.off"})
            if (const shared_mesh model = load_real(setting, path)) models.push_back(*model);
        return copies(models, count);
    });
}

}  // namespace

void crowds(const setting& setting, const contest_visitor& visit) {
    for (const std::size_t count : sphere_counts(setting.effort))
        visit(contest_of({.name = fmt::format("spheres/{}", count),
                          .solids = crowd_of([=] { return spheres(count, poles::joined); }),
                          .also_in_one_mesh = true,
                          .also_by_peer = count <= 125}));
    if (setting.effort == effort::tiny || !load_real(setting, "clean/spot_23k.obj")) return;
    for (const std::size_t count : {std::size_t{75}, std::size_t{300}}) {
        if (count > 75 && setting.effort != effort::full) continue;
        visit(contest_of({.name = fmt::format("animals/{}", count),
                          .solids = copies_of_models(setting, count),
                          .also_in_one_mesh = true}));
    }
}

section draw_crowds(const std::vector<outcome>& outcomes, const std::string& machine) {
    return drawn_by_family(outcomes, "c1", machine);
}

}  // namespace treeform::bench
