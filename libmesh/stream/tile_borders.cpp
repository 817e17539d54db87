/// \file
/// What lies along the borders of tiles: settled in one pass over all of them.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t records_a_check = 65536;
const char* const settled_name = "border.drops";

border_point border_of(numbers r) {
    const auto at = [&](std::size_t i) {
        const auto x = [&](std::size_t k) { return std::bit_cast<double>(r[i + k]); };
        return point3{x(0), x(1), x(2)};
    };
    return {r[0], at(1), r[4], at(5)};
}

}  // namespace

tiles_welded tile_steps::weld_borders() {
    const std::uint64_t points = survey_.cloud.points;
    tiles_welded w(points, rule(), tolerance_, keys_.agree());
    kept_points kept(points);
    const record_count borders = settle_borders(w, kept);
    kept_points without_followers(points);
    longest_move longest = w.border.move();
    if (rule() == weld_rule::first)
        w.border = {rule(), tolerance_};  // for its memory
    else
        longest = longest_chain_move(w.border);
    const auto follow = [&](const std::filesystem::path& path, const record_count& count) {
        record_reader<tile_drop> reader(path, count, piece);
        for (auto drops = reader.next(); !drops.empty(); drops = reader.next()) {
            for (const tile_drop& d : drops) {
                kept.drop(d.id);
                w.groups += without_followers.drop(w.border.leader_of(d.leader)) ? 1 : 0;
            }
            pace_.check();
        }
        w.drops.push_back(count);
    };
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        follow(file(t, ".drops"), tiles_[t].drops);
        longest.consider(tiles_[t].move);
    }
    follow(folder_.file(settled_name), borders);
    if (kept.shares_a_drop(without_followers))
        throw std::logic_error("a point belongs to one that was dropped");
    w.max_displacement = longest.length();
    if (has_order())
        number_kept(kept, w.kept);
    else
        w.kept = std::move(kept);
    if (task_.options.keep != weld_keep::first) w.followed.emplace(std::move(without_followers));
    step_done();
    return w;
}

void tile_steps::number_kept(const kept_points& by_rank, kept_points& kept) const {
    std::uint64_t rank = 0;
    for (row_reader all = numbers_by_rank(); !all.empty(); all.pop(), ++rank)
        if (!by_rank.keeps(rank)) kept.drop(all.front()[0]);
}

/// Writes what the border pass drops, and returns how much that is.
record_count tile_steps::settle_borders(tiles_welded& w, kept_points& kept) const {
    std::vector<row_reader> readers;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        readers.emplace_back(file(t, ".border"), tiles_[t].border, border_width(),
                             bytes_per_reader());
    row_merge merge(std::move(readers), 1);
    record_writer<tile_drop> settled(folder_.file(settled_name), piece);
    std::vector<tile_drop> dropped;
    const auto take = [&] {
        for (const tile_drop& d : dropped) kept.drop(d.id);
        settled.put(dropped);
        dropped.clear();
    };
    for (std::uint64_t count = 0; !merge.empty(); merge.pop(), ++count) {
        const numbers r = merge.front();
        const border_point p = border_of(r);
        w.border.add({&p, 1}, dropped, r.subspan(8));
        take();
        if (count % records_a_check == 0) pace_.check();
    }
    w.border.finish(dropped);
    take();
    return settled.finish();
}

/// Members sorted in pieces that memory holds, and the pieces merged.
longest_move tile_steps::longest_chain_move(const border_weld& border) const {
    const std::vector<record_count> pieces = sorted_members(border);
    std::vector<record_reader<tile_member>> readers;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        readers.emplace_back(members_file(i), pieces[i], piece / 4);
    weld::chain_moves moves;
    record_merge merge(std::move(readers), [](const tile_member& m) { return m.tag; });
    for (std::uint64_t count = 0; !merge.empty(); merge.pop(), ++count) {
        moves.add(merge.front());
        if (count % records_a_check == 0) pace_.check();
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) std::filesystem::remove(members_file(i));
    return moves.move();
}

std::filesystem::path tile_steps::members_file(std::size_t i) const {
    return folder_.file("members." + std::to_string(i));
}

std::vector<record_count> tile_steps::sorted_members(const border_weld& border) const {
    const std::size_t most =
        static_cast<std::size_t>(task_.options.memory / 8) / sizeof(tile_member) + 1;
    std::vector<record_count> pieces;
    std::uint64_t all = 0;
    for (const tile& t : tiles_) all += t.members.records;
    std::vector<tile_member> held;
    held.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(all, most)));
    const auto write = [&] {
        std::sort(held.begin(), held.end(),
                  [](const tile_member& a, const tile_member& b) { return a.tag < b.tag; });
        record_writer<tile_member> writer(members_file(pieces.size()), piece);
        writer.put(held);
        pieces.push_back(writer.finish());
        held.clear();
        pace_.check();
    };
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        record_reader<tile_member> reader(file(t, ".members"), tiles_[t].members, piece);
        for (auto some = reader.next(); !some.empty(); some = reader.next())
            for (const tile_member& m : some) {
                held.push_back(border.settled(m));
                if (held.size() == most) write();
            }
    }
    if (!held.empty()) write();
    return pieces;
}

tile_steps::leaders::leaders(const tile_steps& steps, const tiles_welded& welded)
    : border_(welded.border), drops_(by_rank(steps, welded)) {
    if (!steps.has_order()) return;
    number(steps, *drops_);
    drops_.reset();
}

tile_steps::leaders::drops tile_steps::leaders::by_rank(const tile_steps& s,
                                                        const tiles_welded& w) {
    std::vector<record_reader<tile_drop>> readers;
    for (std::size_t t = 0; t < s.tiles_.size(); ++t)
        readers.emplace_back(s.file(t, ".drops"), w.drops[t], s.bytes_per_reader());
    readers.emplace_back(s.folder_.file(settled_name), w.drops.back(), s.bytes_per_reader());
    return drops(std::move(readers), {});
}

/// From the ranks of points and of their leaders to the numbers of both: by way of the leaders'.
void tile_steps::leaders::number(const tile_steps& s, drops& ranks) {
    row_sorter by_leader(s.folder_, "leaders", {.width = 2, .keys = 2}, s.sorting_memory());
    sorter_ =
        std::make_unique<row_sorter>(s.folder_, "led", row_sorter::shape{2, 1}, s.sorting_memory());
    std::uint64_t rank = 0;
    for (row_reader all = s.numbers_by_rank(); !ranks.empty(); all.pop(), ++rank) {
        std::optional<std::uint64_t> leader;
        for (; !ranks.empty() && ranks.front().id == rank; ranks.pop())
            leader = border_.leader_of(ranks.front().leader);
        if (leader) by_leader.put(std::array{*leader, all.front()[0]});
        if (rank % records_a_check == 0) s.pace_.check();
    }
    rank = 0;
    row_reader all = s.numbers_by_rank();
    for (row_merge led = by_leader.sorted(); !led.empty(); led.pop()) {
        for (; rank < led.front()[0]; ++rank) all.pop();
        sorter_->put(std::array{led.front()[1], all.front()[0]});
    }
    rows_.emplace(sorter_->sorted());
}

std::uint64_t tile_steps::leaders::of(std::uint64_t point) {
    std::uint64_t leader = point;
    if (rows_) {
        if (!rows_->empty() && rows_->front()[0] == point) {
            leader = rows_->front()[1];
            rows_->pop();
        }
        return leader;
    }
    for (; !drops_->empty() && drops_->front().id == point; drops_->pop())
        leader = drops_->front().leader;
    return border_.leader_of(leader);
}

}  // namespace treeform::detail::stream
