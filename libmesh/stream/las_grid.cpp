#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/stream/las_grid.hpp>
#include <libmesh/stream/point_survey.hpp>

#include <algorithm>

namespace treeform::detail::stream {
namespace {

using io::las_grid_choice;

void look_at_all(las_grid_choice& choice, const pass_of_points& each, const communicator& all) {
    each([&](points_view some) { choice.look(some); });
    state_writer sent;
    for (const las_grid_choice::range& r : choice.ranges()) {
        sent.real(r.low);
        sent.real(r.high);
    }
    for (state_reader& one : all.exchange(sent))
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double low = one.real();
            choice.add(axis, {low, one.real()});
        }
}

/// Whether all agree that the scales hold all points.
bool try_on_all(las_grid_choice& choice, const pass_of_points& each, const communicator& all) {
    each([&](points_view some) { choice.try_on(some); });
    state_writer sent;
    sent.number(choice.must_try_again() ? 1 : 0);
    for (const int d : choice.tried()) sent.number(static_cast<std::uint64_t>(d));
    bool agreed = true;
    las_grid_choice::digits most{};
    std::vector<las_grid_choice::digits> tried;
    for (state_reader& one : all.exchange(sent)) {
        agreed = one.number() == 0 && agreed;
        las_grid_choice::digits& of_one = tried.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            of_one[axis] = static_cast<int>(one.number());
            most[axis] = std::max(most[axis], of_one[axis]);
        }
    }
    for (const las_grid_choice::digits& of_one : tried) agreed = agreed && of_one == most;
    choice.start_round(most);
    return agreed;
}

}  // namespace

las_header las_grid_of(const pass_of_points& each, const communicator& all,
                       const io::las_grid_wish& wish) {
    las_grid_choice choice;
    look_at_all(choice, each, all);
    while (!try_on_all(choice, each, all)) {
    }
    las_header header;
    choice.put(header, wish);
    return header;
}

las_header las_grid_of(joined_points& points, const communicator& all, const share& mine,
                       cancellable_progress& pace, const io::las_grid_wish& wish) {
    const auto each = [&](const std::function<void(points_view)>& take) {
        io::point_block block;
        points.rewind(mine);
        while (points.read(block, points_a_block)) {
            take(block.points);
            pace.check();
        }
    };
    return las_grid_of(each, all, wish);
}

}  // namespace treeform::detail::stream
