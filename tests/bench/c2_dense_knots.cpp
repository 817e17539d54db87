/// \file
/// C2: torus knots through each other, most of whose faces meet others: little is hidden.

#include "bench/crowd_contest.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <vector>

namespace treeform::bench {

void dense_knots(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> counts{10, 21, 42};
    if (setting.effort == effort::quick) counts = {5, 10};
    if (setting.effort == effort::tiny) counts = {2};
    for (const std::size_t count : counts)
        visit(contest_of({.name = fmt::format("knots/{}", count),
                          .solids = crowd_of([=] { return torus_knots(count); })}));
}

section draw_dense_knots(const std::vector<outcome>& outcomes, const std::string& machine) {
    return drawn_by_family(outcomes, "c2", machine);
}

}  // namespace treeform::bench
