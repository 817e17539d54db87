/// \file
/// The order in which points are gone through, where it is not that of the files: each rank sorts
/// what it reads, and then has a range of the order.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t ranks_a_check = 65536;
constexpr std::uint64_t samples_each = 2048;  ///< of the points of a process; ranges differ by 10 %

using keyed = std::array<std::uint64_t, 2>;  ///< the key and the number of a point

/// Whether the point is one of those samples, which are spread evenly over any run of numbers.
bool is_sampled(std::uint64_t point, std::uint64_t one_of) {
    return (point * 0x9e3779b97f4a7c15 >> 32) % one_of == 0;
}

/// Where the ranges of all but the first begin.
std::vector<keyed> begins_of_ranges(const communicator& all, const std::vector<keyed>& sample) {
    state_writer mine;
    mine.number(sample.size());
    for (const keyed& one : sample) mine.numbers(one[0], one[1]);
    std::vector<keyed> rows;
    for (state_reader& one : all.exchange(mine))
        for (std::uint64_t left = one.number(); left > 0; --left)
            rows.push_back({one.number(), one.number()});
    std::sort(rows.begin(), rows.end());
    std::vector<keyed> begins;
    for (std::size_t r = 1; r < all.size() && !rows.empty(); ++r)
        begins.push_back(rows[rows.size() * r / all.size()]);
    return begins;
}

}  // namespace

std::filesystem::path tile_steps::numbers_file(std::size_t part) const {
    return folder_.file(part == 0 ? "numbers" : "numbers." + std::to_string(part));
}

std::filesystem::path tile_steps::ranks_file() const {
    return folder_.file("ranks." + std::to_string(communicator_.rank()));
}

/// Of several ranks, each looks at some parts.
bool tile_steps::has_numbers() const {
    for (std::size_t part = communicator_.rank(); part < numbers_.size();
         part += communicator_.size())
        if (!is_whole<std::uint64_t>(numbers_file(part), numbers_[part])) return false;
    return true;
}

void tile_steps::rank_points() {
    const share mine = read_by(communicator_.rank());
    const std::uint64_t points = survey_.cloud.points;
    const std::uint64_t one_of = points / communicator_.size() / samples_each + 1;
    auto by_key =
        std::make_unique<row_sorter>(folder_, "keys." + std::to_string(communicator_.rank()),
                                     row_sorter::shape{2, 2}, sorting_memory());
    std::vector<keyed> sample;
    source_.rewind(mine);
    io::point_block block;
    std::vector<std::uint64_t> keys;
    std::uint64_t id = mine.first;
    while (source_.read(block, points_a_block)) {
        keys_.order_of(block, keys);
        for (const std::uint64_t key : keys) {
            const keyed row{key, id++};
            by_key->put(row);
            if (!communicator_.is_alone() && is_sampled(row[1], one_of)) sample.push_back(row);
        }
        pace_.show("scatter", 0.4 * static_cast<double>(id - mine.first) /
                                  static_cast<double>(points / communicator_.size() + 1));
    }
    row_merge own = by_key->sorted();
    if (communicator_.is_alone()) return number_by_rank(own, 0);
    const std::vector<keyed> begins = begins_of_ranges(communicator_, sample);
    all_to_all by_range(folder_, communicator_, "keys", 2, sorting_memory() / 2);
    for (; !own.empty(); own.pop()) {
        const keyed row{own.front()[0], own.front()[1]};
        const auto to = std::upper_bound(begins.begin(), begins.end(), row) - begins.begin();
        by_range.put(static_cast<std::size_t>(to), row);
    }
    by_key.reset();
    by_range.send();
    row_merge all(by_range.received(), 2);
    number_by_rank(all, by_range.rows_before());
    by_range.remove_received();
}

/// `rank` is that of the first row.
void tile_steps::number_by_rank(row_merge& by_key, std::uint64_t rank) {
    shared_sorter by_number(folder_, communicator_, "keys.ranks", {.width = 2, .keys = 1},
                            sorting_memory());
    row_writer in_order(numbers_file(communicator_.rank()), piece);
    for (; !by_key.empty(); by_key.pop(), ++rank) {
        const std::uint64_t id = by_key.front()[1];
        in_order.put(id);
        by_number.put(owner_of(id), std::array{id, rank});
        if (rank % ranks_a_check == 0) pace_.check();
    }
    state_writer sent;
    store_count(in_order.finish(), sent);
    row_writer ranks(ranks_file(), piece);
    for (row_merge all = by_number.sorted(); !all.empty(); all.pop()) ranks.put(all.front()[1]);
    ranks_ = ranks.finish_unsynced();
    numbers_.clear();
    for (state_reader& one : communicator_.exchange(sent)) numbers_.push_back(load_count(one));
}

row_chain tile_steps::numbers_by_rank(const share& some) const {
    std::vector<row_chain::file> files;
    std::uint64_t first = 0;
    for (std::size_t part = 0; part < numbers_.size(); ++part) {
        const std::uint64_t last = first + numbers_[part].records;
        const std::uint64_t from = std::max(first, some.first);
        const std::uint64_t to = std::min(last, some.last);
        if (from < to)
            files.push_back({numbers_file(part), numbers_[part], {from - first, to - first}});
        first = last;
    }
    return {std::move(files), 1, piece};
}

kept_points tile_steps::number_kept(const kept_points& by_rank) const {
    kept_points kept(survey_.cloud.points);
    std::uint64_t rank = 0;
    for (row_chain all = numbers_by_rank(); !all.empty(); all.pop(), ++rank)
        if (!by_rank.keeps(rank)) kept.drop(all.front()[0]);
    return kept;
}

/// For the places in the order that are assigned to a process: informs the processes to which the
/// numbers of these points are assigned.
kept_points tile_steps::number_kept_by_all(const share& assigned,
                                           const kept_points& by_rank) const {
    if (communicator_.is_alone()) return number_kept(by_rank);
    all_to_all dropped(folder_, communicator_, "dropped", 1, sorting_memory());
    std::uint64_t rank = assigned.first;
    for (row_chain all = numbers_by_rank(assigned); !all.empty(); all.pop(), ++rank)
        if (!by_rank.keeps(rank)) dropped.put(owner_of(all.front()[0]), all.front());
    dropped.send();
    kept_points kept(assigned.size(), assigned.first);
    for (row_reader& from : dropped.received())
        for (; !from.empty(); from.pop()) kept.drop(from.front()[0]);
    dropped.remove_received();
    return kept;
}

tile_steps::leaders::leaders(const tile_steps& steps, const communicator& all,
                             const tiles_welded& welded)
    : border_(welded.border) {
    drops_.emplace(steps.sorted_drops(welded.drops));
    if (steps.has_order()) number(steps, all, welded.points, *drops_);
}

/// From the ranks of points and of their leaders to the numbers of both: by way of the leaders'.
void tile_steps::leaders::number(const tile_steps& s, const communicator& all,
                                 const share& assigned, row_merge& ranks) {
    const auto owner = [&](std::uint64_t i) { return all.owner_of(i, s.survey_.cloud.points); };
    shared_sorter by_leader(s.folder_, all, "leaders", {.width = 2, .keys = 2}, s.sorting_memory());
    sorter_ = std::make_unique<shared_sorter>(s.folder_, all, "led", row_sorter::shape{2, 1},
                                              s.sorting_memory());
    std::uint64_t rank = assigned.first;
    for (row_chain points = s.numbers_by_rank(assigned); !ranks.empty(); points.pop(), ++rank) {
        std::optional<std::uint64_t> leader;
        for (; !ranks.empty() && ranks.front()[0] == rank; ranks.pop())
            leader = border_.leader_of(ranks.front()[1]);
        if (leader) by_leader.put(owner(*leader), std::array{*leader, points.front()[0]});
        if (rank % ranks_a_check == 0) s.pace_.check();
    }
    rank = assigned.first;
    row_chain points = s.numbers_by_rank(assigned);
    for (row_merge led = by_leader.sorted(); !led.empty(); led.pop()) {
        for (; rank < led.front()[0]; ++rank) points.pop();
        const std::uint64_t point = led.front()[1];
        sorter_->put(owner(point), std::array{point, points.front()[0]});
    }
    is_by_number_ = true;
    drops_.emplace(sorter_->sorted());
}

std::uint64_t tile_steps::leaders::of(std::uint64_t point) {
    std::uint64_t leader = point;
    for (; !drops_->empty() && drops_->front()[0] == point; drops_->pop())
        leader = drops_->front()[1];
    return is_by_number_ ? leader : border_.leader_of(leader);
}

}  // namespace treeform::detail::stream
