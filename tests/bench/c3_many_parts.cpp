/// \file
/// C3: a plate with holes, cubes face to face, cubes at random: many small solids, most of whose
/// faces the result has.

#include "bench/crowd_contest.hpp"

#include <fmt/core.h>

#include <array>
#include <cstddef>

namespace treeform::bench {
namespace {

/// How many of each there are.
struct part_counts {
    std::size_t holes_a_side;
    std::array<std::size_t, 3> touching;
    std::size_t at_random;
};

std::vector<part_counts> counts_of(effort effort) {
    if (effort == effort::tiny) return {{2, {3, 2, 2}, 8}};
    std::vector<part_counts> counts{{10, {5, 5, 4}, 200}, {22, {10, 10, 10}, 1000}};
    if (effort == effort::full) counts.push_back({50, {25, 20, 20}, 5000});
    return counts;
}

}  // namespace

void many_parts(const setting& setting, const contest_visitor& visit) {
    const std::vector<part_counts> counts = counts_of(setting.effort);
    for (const part_counts& of : counts)
        visit(contest_of({.name = fmt::format("plate/{}", of.holes_a_side * of.holes_a_side),
                          .solids = crowd_of([=] { return plate_and_cylinders(of.holes_a_side); }),
                          .expression = boolean_expression::difference_of}));
    for (const part_counts& of : counts) {
        const auto [x, y, z] = of.touching;
        visit(contest_of(
            {.name = fmt::format("touching cubes/{}", x * y * z),
             .solids = crowd_of([=, x = x, y = y, z = z] { return touching_cubes(x, y, z); }),
             .also_in_one_mesh = true}));
    }
    for (const part_counts& of : counts)
        visit(contest_of({.name = fmt::format("random cubes/{}", of.at_random),
                          .solids = crowd_of([=] { return random_cubes(of.at_random); }),
                          .also_in_one_mesh = true,
                          .also_by_peer = of.at_random <= 1000}));
}

section draw_many_parts(const std::vector<outcome>& outcomes, const std::string& machine) {
    return drawn_by_family(outcomes, "c3", machine);
}

}  // namespace treeform::bench
