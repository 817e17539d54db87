#include "tools/tf-weld/tile_steps.hpp"

#include "tools/common/console.hpp"
#include <libmesh/base/finite.hpp>
#include <treeform/mesh/crowded_chain.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace tools {
namespace {

using tf::border_point;
using tf::tile_drop;
using tf::tile_member;
using tf::tile_point;
using tf::tile_role;

constexpr std::size_t piece = std::size_t{1} << 20;  ///< bytes read or written at a time

json to_json(const record_count& c) { return {c.records, c.digest}; }
record_count count_from(const json& stored) { return {stored.at(0), stored.at(1)}; }

json to_json(const tf::longest_move& m) {
    return {m.from().x, m.from().y, m.from().z, m.to().x, m.to().y, m.to().z};
}
tf::longest_move move_from(const json& s) {
    tf::longest_move m;
    m.consider({s.at(0), s.at(1), s.at(2)}, {s.at(3), s.at(4), s.at(5)});
    return m;
}

/// The points of tiles on their way to their files.
class scattered {
  public:
    scattered(std::size_t tiles, std::size_t bytes_each)
        : most_(bytes_each / sizeof(tile_point) + 1), rows_(tiles) {}

    template <class Flush>
    void put(std::size_t tile, const tile_point& p, const Flush& flush) {
        std::vector<tile_point>& row = rows_[tile];
        if (row.empty()) row.reserve(most_);
        row.push_back(p);
        if (row.size() < most_) return;
        flush(tile, row);
        row.clear();
    }
    template <class Flush>
    void finish(const Flush& flush) {
        for (std::size_t t = 0; t < rows_.size(); ++t) {
            flush(t, rows_[t]);
            rows_[t] = {};
        }
    }

  private:
    std::size_t most_;
    std::vector<std::vector<tile_point>> rows_;
};

template <class Record>
bool is_whole(const std::filesystem::path& path, const record_count& expected) {
    std::error_code error;
    if (std::filesystem::file_size(path, error) != expected.records * sizeof(Record) || error)
        return false;
    record_reader<Record> reader(path, expected, piece);
    try {
        while (!reader.next().empty()) {
        }
    } catch (const failure&) {
        return false;
    }
    return true;
}

}  // namespace

tile_steps::tile_steps(job& work, work_folder& folder, const tile_task& task)
    : work_(work), folder_(folder), task_(task) {}

void tile_steps::step_done() {
    if (task_.stop_at > 0 && ++steps_ == task_.stop_at) std::raise(SIGKILL);
}

std::filesystem::path tile_steps::file(std::size_t t, const char* what) const {
    return folder_.file(std::to_string(t) + what);
}

tf::weld_rule tile_steps::rule() const {
    return tolerance_ > 0.0 ? task_.rule : tf::weld_rule::first;
}

std::uint64_t tile_steps::bytes_per_point() const {
    return rule() == tf::weld_rule::first ? 64 : 110;
}

std::size_t tile_steps::bytes_per_reader() const {
    const std::uint64_t share = task_.memory / 16 / (tiles_.size() + 1);
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(share, 4096, piece));
}

const point_survey& tile_steps::look() {
    const auto stored = folder_.load("plan.json");
    if (stored && take_over(*stored)) return survey_;
    if (stored)
        work_.warn("started-anew", folder_.path().string() +
                                       ": what is there is of no use for this input and these "
                                       "options; started again");
    folder_.clear();
    tiles_.clear();
    survey_ = survey(work_, task_.input);
    return survey_;
}

bool tile_steps::take_over(const json& plan) {
    try {
        if (plan.at("identity") != task_.identity) return false;
        survey_ = survey_from(plan.at("survey"));
        for (const json& t : plan.at("tiles"))
            tiles_.push_back({.points = count_from(t), .own = t.at(2)});
        for (std::size_t t = 0; t < tiles_.size(); ++t) take_over_tile(t);
    } catch (const json::exception&) {
        return false;
    }
    std::size_t finished = 0;
    bool whole = true;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        finished += tiles_[t].finished ? 1 : 0;
        std::error_code error;
        whole =
            whole && (tiles_[t].finished || std::filesystem::file_size(file(t, ".points"), error) ==
                                                tiles_[t].points.records * sizeof(tile_point));
    }
    if (whole)
        work_.out.info(work_.name + ": continued in " + folder_.path().string() + ", " +
                       grouped(finished) + " of " + counted(tiles_.size(), "tile", "tiles") +
                       " finished before");
    return whole;
}

void tile_steps::take_over_tile(std::size_t t) {
    const auto stored = folder_.load(std::to_string(t) + ".done");
    if (!stored) return;
    tile& mine = tiles_[t];
    mine.drops = count_from(stored->at("drops"));
    mine.border = count_from(stored->at("border"));
    mine.members = count_from(stored->at("members"));
    mine.move = move_from(stored->at("move"));
    mine.finished = is_whole<tile_drop>(file(t, ".drops"), mine.drops) &&
                    is_whole<border_point>(file(t, ".border"), mine.border) &&
                    is_whole<tile_member>(file(t, ".members"), mine.members);
    if (!mine.finished)
        work_.warn("damaged", file(t, ".drops").string() +
                                  ": this tile's files are not what was written; done again");
}

void tile_steps::scatter(double tolerance) {
    tolerance_ = tolerance;
    if (!tiles_.empty()) return;
    const tf::tile_slabs slabs = plan();
    survey_.sample = {};
    tiles_.resize(slabs.size());
    // Tiles' points are removed as their drops are written, which take half as much at most.
    // Members, few mostly, are not counted.
    const std::uint64_t needed = survey_.points * (sizeof(tile_point) + 2);
    work_.out.info(work_.name + ": " + grouped(survey_.points) + " points in " +
                   counted(slabs.size(), "tile", "tiles") + ", about " +
                   grouped(needed / 1000000 + 1) + " MB on the disk in " + folder_.path().string());
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (!unknown && space.available < needed)
        work_.warn("space", folder_.path().string() + ": only " +
                                grouped(space.available / 1000000) + " MB left on the disk of " +
                                grouped(needed / 1000000 + 1) + " needed; --work names another");

    tf::point_reader reader(task_.input, work_.options.format);
    const auto show = work_.progress("scatter");
    std::vector<digest> digests(slabs.size());
    const auto flush = [&](std::size_t t, const std::vector<tile_point>& row) {
        const auto bytes = std::as_bytes(std::span(row));
        append_to(file(t, ".points"), bytes);
        digests[t].add(bytes);
        tiles_[t].points.records += row.size();
    };
    scattered rows(slabs.size(), static_cast<std::size_t>(std::min<std::uint64_t>(
                                     piece, task_.memory / 4 / slabs.size())));
    tf::point_block block;
    std::uint64_t id = 0;
    while (reader.read(block, points_a_block)) {
        for (const tf::point3& p : block.points) {
            const std::uint64_t mine = id++;
            if (!tf::detail::base::is_finite(p)) continue;
            const auto place = slabs.find(p);
            ++tiles_[place.own].own;
            for (std::uint32_t t = place.first; t <= place.last; ++t) {
                const tile_role role = t != place.own              ? tile_role::halo
                                       : place.first == place.last ? tile_role::own
                                                                   : tile_role::shared;
                rows.put(t, tile_point::make(mine, role, p), flush);
            }
        }
        show(static_cast<double>(id) / static_cast<double>(survey_.points));
        work_.keeper.check();
    }
    rows.finish(flush);
    work_.out.end_progress();

    json plan{{"identity", task_.identity}, {"survey", tools::to_json(survey_)}};
    std::uint64_t own = survey_.non_finite;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        tiles_[t].points.digest = digests[t].value();
        own += tiles_[t].own;
        plan["tiles"].push_back({tiles_[t].points.records, tiles_[t].points.digest, tiles_[t].own});
    }
    if (id != survey_.points || own != survey_.points)
        throw failure(bad_input, "changed", work_.name + ": the file changed while it was read");
    folder_.store("plan.json", plan);
    step_done();
}

std::size_t tile_steps::at_a_time() const {
    std::uint64_t largest = 1;
    for (const tile& t : tiles_) largest = std::max(largest, t.points.records);
    const double room = 0.7 * static_cast<double>(task_.memory);
    const double each = static_cast<double>(largest * bytes_per_point() + 4 * piece);
    return static_cast<std::size_t>(std::clamp(room / each, 1.0, 64.0));
}

void tile_steps::weld_tiles() {
    const auto show = work_.progress("weld");
    std::mutex one_at_a_time;
    std::size_t finished = 0;
    const auto weld = [&](std::size_t t) {
        const bool before = tiles_[t].finished;
        if (!before) weld_tile(t);
        const std::lock_guard lock(one_at_a_time);
        tiles_[t].finished = true;
        if (!before) step_done();
        show(static_cast<double>(++finished) / static_cast<double>(tiles_.size()));
    };
    const auto few = static_cast<unsigned>(at_a_time());
    if (few == 1) {  // threads are for what is inside
        for (std::size_t t = 0; t < tiles_.size(); ++t) weld(t);
    } else {
        const tf::thread_scope some(few);
        tf::for_chunks(tiles_.size(), 1, [&](std::size_t t, std::size_t, std::size_t) { weld(t); });
    }
    work_.out.end_progress();
}

/// What a tile leaves, on its way to the disk.
struct tile_steps::tile_files {
    record_writer<tile_drop> dropped;
    record_writer<border_point> border;
    record_writer<tile_member> members;
    tf::tile_result result{};

    void write() {
        dropped.put(result.dropped);
        border.put(result.border);
        members.put(result.members);
        result.dropped.clear();
        result.border.clear();
        result.members.clear();
    }
};

template <class Take>
void tile_steps::each_point_of(std::size_t t, const Take& take) {
    record_reader<tile_point> points(file(t, ".points"), tiles_[t].points, piece);
    for (auto row = points.next(); !row.empty(); row = points.next()) {
        take(row);
        work_.keeper.check();
    }
}

void tile_steps::weld_tile(std::size_t t) {
    tile& mine = tiles_[t];
    tile_files files{{file(t, ".drops"), piece / 4},
                     {file(t, ".border"), piece / 4},
                     {file(t, ".members"), piece / 4}};
    const std::uint64_t room = task_.memory / 10 * 7 / bytes_per_point();
    if (rule() == tf::weld_rule::chain && mine.points.records > room)
        weld_crowded(t, files);
    else
        weld_held(t, files);
    mine.drops = files.dropped.finish();
    mine.border = files.border.finish();
    mine.members = files.members.finish();
    mine.move = files.result.move;
    folder_.store(std::to_string(t) + ".done", {{"drops", to_json(mine.drops)},
                                                {"border", to_json(mine.border)},
                                                {"members", to_json(mine.members)},
                                                {"move", to_json(mine.move)}});
    std::filesystem::remove(file(t, ".points"));
}

void tile_steps::weld_held(std::size_t t, tile_files& files) {
    tf::tile_weld weld(rule(), tolerance_);
    const std::uint64_t room = task_.memory / 2 / bytes_per_point();
    weld.reserve(static_cast<std::size_t>(std::min(tiles_[t].points.records, room)));
    each_point_of(t, [&](auto row) {
        weld.add(row, files.result);
        files.write();
    });
    for (bool more = true; more; files.write()) more = weld.finish(files.result);
}

void tile_steps::weld_crowded(std::size_t t, tile_files& files) {
    tf::crowded_chain weld(tolerance_);
    each_point_of(t, [&](auto row) { weld.look(row); });
    each_point_of(t, [&](auto row) { weld.link(row); });
    each_point_of(t, [&](auto row) {
        weld.settle(row, files.result);
        files.write();
    });
}

/// Members sorted in pieces that memory holds, and the pieces merged.
tf::longest_move tile_steps::longest_chain_move(const tf::border_weld& border) const {
    const auto tag_of = [](const tile_member& m) { return m.tag; };
    const std::size_t most = static_cast<std::size_t>(task_.memory / 8) / sizeof(tile_member) + 1;
    std::vector<record_count> pieces;
    std::uint64_t all = 0;
    for (const tile& t : tiles_) all += t.members.records;
    std::vector<tile_member> held;
    held.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(all, most)));
    const auto piece_file = [&](std::size_t i) {
        return folder_.file("members." + std::to_string(i));
    };
    const auto write = [&] {
        std::sort(held.begin(), held.end(),
                  [](const tile_member& a, const tile_member& b) { return a.tag < b.tag; });
        record_writer<tile_member> writer(piece_file(pieces.size()), piece);
        writer.put(held);
        pieces.push_back(writer.finish());
        held.clear();
        work_.keeper.check();
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
    held = {};
    std::vector<record_reader<tile_member>> readers;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        readers.emplace_back(piece_file(i), pieces[i], piece / 4);
    tf::chain_moves moves;
    record_merge merge(std::move(readers), tag_of);
    for (std::uint64_t count = 0; !merge.empty(); merge.pop(), ++count) {
        moves.add(merge.front());
        if (count % 65536 == 0) work_.keeper.check();
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) std::filesystem::remove(piece_file(i));
    return moves.move();
}

tiles_welded tile_steps::weld_borders() {
    tiles_welded w(survey_.points, rule(), tolerance_);
    std::vector<record_reader<border_point>> readers;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        readers.emplace_back(file(t, ".border"), tiles_[t].border, bytes_per_reader());
    record_merge merge(std::move(readers), [](const border_point& p) { return p.id(); });
    record_writer<tile_drop> settled(folder_.file("border.drops"), piece);
    std::vector<tile_drop> dropped;
    const auto take = [&] {
        for (const tile_drop& d : dropped) w.kept.drop(d.id);
        settled.put(dropped);
        dropped.clear();
    };
    for (std::uint64_t count = 0; !merge.empty(); merge.pop(), ++count) {
        w.border.add({&merge.front(), 1}, dropped);
        take();
        if (count % 65536 == 0) work_.keeper.check();
    }
    w.border.finish(dropped);
    take();
    const record_count borders = settled.finish();

    kept_points without_followers(survey_.points);
    tf::longest_move longest = w.border.move();
    if (rule() == tf::weld_rule::first)
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
            work_.keeper.check();
        }
        w.drops.push_back(count);
    };
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        follow(file(t, ".drops"), tiles_[t].drops);
        longest.consider(tiles_[t].move);
    }
    follow(folder_.file("border.drops"), borders);
    if (w.kept.shares_a_drop(without_followers))
        throw std::logic_error("a point belongs to one that was dropped");
    w.largest_move = longest.length();
    step_done();
    return w;
}

tile_steps::drops tile_steps::all_drops(const tiles_welded& w) const {
    std::vector<record_reader<tile_drop>> readers;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        readers.emplace_back(file(t, ".drops"), w.drops[t], bytes_per_reader());
    readers.emplace_back(folder_.file("border.drops"), w.drops.back(), bytes_per_reader());
    return drops(std::move(readers), {});
}

}  // namespace tools
