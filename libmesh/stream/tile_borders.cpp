/// \file
/// What lies along the borders of tiles: settled in one pass over all of them.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t records_a_check = 65536;
const char* const settled_name = "border.drops";

}  // namespace

tiles_welded tile_steps::weld_borders() {
    tiles_welded w(survey_.cloud.points, rule(), tolerance_);
    const record_count borders = settle_borders(w);
    kept_points without_followers(survey_.cloud.points);
    longest_move longest = w.border.move();
    if (rule() == weld_rule::first)
        w.border = {rule(), tolerance_};  // for its memory
    else
        longest = longest_chain_move(w.border);
    const auto follow = [&](const std::filesystem::path& path, const record_count& count) {
        record_reader<tile_drop> reader(path, count, piece);
        for (auto row = reader.next(); !row.empty(); row = reader.next()) {
            for (const tile_drop& d : row) {
                w.kept.drop(d.id);
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
    if (w.kept.shares_a_drop(without_followers))
        throw std::logic_error("a point belongs to one that was dropped");
    w.max_displacement = longest.length();
    step_done();
    return w;
}

/// Writes what the border pass drops, and returns how much that is.
record_count tile_steps::settle_borders(tiles_welded& w) const {
    std::vector<record_reader<border_point>> readers;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        readers.emplace_back(file(t, ".border"), tiles_[t].border, bytes_per_reader());
    record_merge merge(std::move(readers), [](const border_point& p) { return p.id(); });
    record_writer<tile_drop> settled(folder_.file(settled_name), piece);
    std::vector<tile_drop> dropped;
    const auto take = [&] {
        for (const tile_drop& d : dropped) w.kept.drop(d.id);
        settled.put(dropped);
        dropped.clear();
    };
    for (std::uint64_t count = 0; !merge.empty(); merge.pop(), ++count) {
        w.border.add({&merge.front(), 1}, dropped);
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
        for (auto row = reader.next(); !row.empty(); row = reader.next())
            for (const tile_member& m : row) {
                held.push_back(border.settled(m));
                if (held.size() == most) write();
            }
    }
    if (!held.empty()) write();
    return pieces;
}

tile_steps::drops tile_steps::all_drops(const tiles_welded& w) const {
    std::vector<record_reader<tile_drop>> readers;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        readers.emplace_back(file(t, ".drops"), w.drops[t], bytes_per_reader());
    readers.emplace_back(folder_.file(settled_name), w.drops.back(), bytes_per_reader());
    return drops(std::move(readers), {});
}

}  // namespace treeform::detail::stream
