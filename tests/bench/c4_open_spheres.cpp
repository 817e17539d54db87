/// \file
/// C4: spheres that rounding has left open at a pole. That there is no solid is known before
/// anything is cut.

#include "bench/crowd_contest.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <vector>

namespace treeform::bench {

void open_spheres(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> counts{125, 500};
    if (setting.effort == effort::tiny) counts = {3};
    for (const std::size_t count : counts)
        visit(contest_of({.name = fmt::format("open spheres/{}", count),
                          .solids = crowd_of([=] { return spheres(count, poles::apart); }),
                          .also_in_one_mesh = true,
                          .is_open = true}));
}

section draw_open_spheres(const std::vector<outcome>& outcomes, const std::string& machine) {
    return drawn_by_family(outcomes, "c4", machine);
}

}  // namespace treeform::bench
