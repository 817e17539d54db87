#include <libmesh/base/point_math.hpp>
#include <libmesh/round/mending_schedule.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace treeform::detail::round {
namespace {

/// The share 2^-bits of the largest coordinate, rounded up to a power of two.
double reach_of_bits(points_view points, int bits) {
    double largest = 0.0;
    for (const point3& p : points) largest = std::max(largest, base::largest_of(p));
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::max(std::ldexp(1.0, exponent - bits), std::numeric_limits<double>::min());
}

int bits_of_first_step(precision p) { return p == precision::float32 ? 22 : 48; }

}  // namespace

mending_schedule mending_schedule::of_operands(int steps, treeform::precision precision) {
    const int of_surface = std::min(steps, 2);
    return {precision, of_surface, steps - of_surface};
}

bool mending_schedule::mends_surface(const mending_state& state) const {
    const bool is_better = state.meeting < state.meeting_before;
    const int most_steps = state.only_cut ? 12 : 4;
    if (state.steps >= surface_steps &&
        !(surface_steps > 0 && state.steps < most_steps && is_better))
        return false;
    const bool is_worse = state.steps > 0 && state.meeting > 2 * state.meeting_before + 1000;
    return !is_worse && state.faces <= 4 * state.faces_given + 1000;
}

double mending_schedule::reach_of_surface(points_view points, int step) const {
    return reach_of_bits(points, bits_of_first_step(precision) - 2 * (step - 1));
}

double mending_schedule::reach_of_operands(points_view points, int step) const {
    return reach_of_bits(points, bits_of_first_step(precision) - 4 * (step - 1));
}

double mending_schedule::grid_of_surface(points_view points, int step) const {
    return reach_of_bits(points, bits_of_first_step(precision) - 1 - 4 * step);
}

std::vector<double> mending_schedule::grids_of_surface(points_view points, int step,
                                                       double limit) const {
    std::vector<double> grids;
    for (double grid = grid_of_surface(points, step);
         static_cast<int>(grids.size()) < most_grids && grid / 2 <= limit; grid *= 4)
        grids.push_back(grid);
    return grids;
}

double mending_schedule::grid_of_operands(points_view points, int step) const {
    return reach_of_operands(points, step);
}

bool mending_schedule::are_few(const mending_state& state) {
    return state.meeting < state.faces / 16;
}

bool mending_schedule::mends_on_grid(const mending_state& state) {
    const bool is_better = state.meeting < state.meeting_before;
    const bool are_few = 2 * state.meeting < state.faces / 16;
    const bool is_nearly_done = are_few && 32 * state.meeting <= state.meeting_at_first;
    return (state.steps == 0 || is_better || (state.steps == 1 && are_few) || is_nearly_done) &&
           state.steps < most_rounds_of_grid && state.faces <= 3 * state.faces_given + 1000;
}

int mending_schedule::rounds_of_try(int left) {
    return std::min(left, std::max((left + 1) / 2, 3));
}

std::uint64_t mending_schedule::most_meeting(std::uint64_t meeting) { return 4 * meeting + 1000; }

bool mending_schedule::is_too_much(std::uint64_t pairs, std::size_t faces_given) {
    return pairs > 3 * faces_given + 1000;
}

std::uint64_t mending_schedule::most_pairs(std::uint64_t pairs_given) {
    return 4 * pairs_given + 1000;
}

std::uint64_t mending_schedule::most_pairs_joined(std::uint64_t pairs_given) {
    return 64 * pairs_given + 10'000;
}

}  // namespace treeform::detail::round
