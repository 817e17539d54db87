#include <libmesh/stream/all_to_all.hpp>
#include <libmesh/stream/new_numbers.hpp>

#include <array>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t points_a_check = 65536;

}  // namespace

new_numbers::new_numbers(cancellable_progress& pace, const work_folder& folder,
                         const communicator& all, tile_steps& steps, tiles_welded& welded)
    : welded_(welded), leaders_(steps, all, welded) {
    welded.kept.number();
    if (!all.is_alone()) ask_others(pace, folder, all, steps);
}

/// The rank that a point is assigned to knows its number: it is asked for those of the points that
/// belong to it.
void new_numbers::ask_others(cancellable_progress& pace, const work_folder& folder,
                             const communicator& all, const tile_steps& steps) {
    const share& mine = welded_.points;
    state_writer kept;
    kept.number(mine.size() - welded_.kept.dropped());
    std::vector<state_reader> received = all.exchange(kept);
    for (std::size_t r = 0; r < all.rank(); ++r) before_ += received[r].number();
    const std::uint64_t points = steps.survey().points;
    const std::uint64_t memory = steps.sorting_memory() / 2;
    all_to_all asked(folder, all, "asked", 2, memory);
    for (std::uint64_t point = mine.first; point < mine.last; ++point) {
        if (point % points_a_check == 0) pace.check();
        if (welded_.kept.keeps(point)) continue;
        const std::uint64_t leader = leaders_.of(point);
        asked.put(all.owner_of(leader, points), std::array{point, leader});
    }
    asked.send();
    all_to_all answers(folder, all, "answers", 2, memory);
    for (row_merge rows(asked.received(), 1); !rows.empty(); rows.pop()) {
        const std::uint64_t point = rows.front()[0];
        const std::uint64_t number = before_ + welded_.kept.number_of(rows.front()[1]);
        answers.put(all.owner_of(point, points), std::array{point, number});
    }
    asked.remove_received();
    answers.send();
    of_dropped_.emplace(answers.received(), 1);
}

std::uint64_t new_numbers::of(std::uint64_t point) {
    if (welded_.kept.keeps(point)) return before_ + welded_.kept.number_of(point);
    if (!of_dropped_) return welded_.kept.number_of(leaders_.of(point));
    const std::uint64_t number = of_dropped_->front()[1];
    of_dropped_->pop();
    return number;
}

}  // namespace treeform::detail::stream
