#include <libmesh/base/point_math.hpp>
#include <libmesh/stream/tile_steps.hpp>
#include <libmesh/weld/crowded_chain.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>

namespace treeform::detail::stream {
namespace {

std::array<std::uint64_t, 8> row_of(const border_point& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    const point3& p = b.at;
    const point3& q = b.leader_at;
    return {b.tag, bits(p.x), bits(p.y), bits(p.z), b.leader, bits(q.x), bits(q.y), bits(q.z)};
}

/// The points of tiles on their way to their files, as rows of numbers.
class scattered {
  public:
    scattered(std::size_t tiles, std::size_t bytes_each)
        : most_(bytes_each / sizeof(std::uint64_t) + 1), rows_(tiles) {}

    template <class Flush>
    void put(std::size_t tile, const tile_point& p, numbers values, const Flush& flush) {
        std::vector<std::uint64_t>& rows = rows_[tile];
        if (rows.empty()) rows.reserve(most_ + 4 + values.size());
        rows.push_back(p.tag);
        for (std::size_t k = 0; k < 3; ++k) rows.push_back(std::bit_cast<std::uint64_t>(p.at[k]));
        rows.insert(rows.end(), values.begin(), values.end());
        if (rows.size() < most_) return;
        flush(tile, rows);
        rows.clear();
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
    std::vector<std::vector<std::uint64_t>> rows_;
};

/// Points with their values, out of rows.
class unpacked {
  public:
    explicit unpacked(std::size_t width) : width_(width) {}

    void put(numbers rows) {
        for (; !rows.empty(); rows = rows.subspan(width_)) {
            const auto at = [&](std::size_t k) { return std::bit_cast<double>(rows[k]); };
            points_.push_back({rows[0], {at(1), at(2), at(3)}});
            values_.insert(values_.end(), rows.begin() + 4,
                           rows.begin() + static_cast<std::ptrdiff_t>(width_));
        }
    }
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    template <class Take>
    void give(const Take& take) {
        if (!points_.empty()) take(std::span<const tile_point>(points_), numbers(values_));
        points_.clear();
        values_.clear();
    }

  private:
    std::size_t width_;
    std::vector<tile_point> points_{};
    std::vector<std::uint64_t> values_{};
};

}  // namespace

tile_steps::tile_steps(pacer& pace, const work_folder& folder, const tile_task& task,
                       joined_points& source, const point_keys& keys)
    : pace_(pace), folder_(folder), task_(task), source_(source), keys_(keys) {}

void tile_steps::step_done() const {
    if (task_.options.step_done) task_.options.step_done();
}

std::filesystem::path tile_steps::file(std::size_t t, const char* what) const {
    return folder_.file(std::to_string(t) + what);
}

weld_rule tile_steps::rule() const {
    const bool chains_of_equal_points = !keys_.agree().is_transitive();
    return tolerance_ > 0.0 || chains_of_equal_points ? task_.options.rule : weld_rule::first;
}

std::uint64_t tile_steps::bytes_per_point() const {
    const std::uint64_t of_values = values() > 0 ? 8 * values() + 12 : 0;
    return (rule() == weld_rule::first ? 64 : 110) + of_values;
}

std::size_t tile_steps::bytes_per_reader() const {
    const std::uint64_t share = task_.options.memory / 16 / (tiles_.size() + 1);
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(share, 4096, piece));
}

void tile_steps::set_tolerance() {
    const std::optional<box3>& box = survey_.cloud.box;
    const double share = task_.options.relative ? (box ? diagonal(*box) : 0.0) : 1.0;
    tolerance_ = share * task_.options.tolerance;
    survey_.cloud.tolerance = tolerance_;
}

void tile_steps::say_plan() {
    cloud_survey& cloud = survey_.cloud;
    cloud.tiles = cuts_ ? cuts_->size() : tiles_.size();
    if (!cuts_) return;
    // Tiles' points are removed as their drops are written, which take half as much at most.
    // Members, few mostly, are not counted.
    cloud.disk_bytes = cloud.points * (8 * point_width() + 2 + (has_order() ? 48 : 0));
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (!unknown) cloud.disk_bytes_free = space.available;
}

void tile_steps::scatter() {
    if (!cuts_) return;
    survey_.sample = {};
    survey_.places.reset();
    tiles_.resize(cuts_->size());
    if (has_order()) rank_points();
    give_points();
    cuts_.reset();
    store_plan();
    step_done();
}

void tile_steps::rank_points() {
    row_sorter by_key(folder_, "keys", {.width = 2, .keys = 2}, sorting_memory());
    ranks_ =
        std::make_unique<row_sorter>(folder_, "ranks", row_sorter::shape{2, 1}, sorting_memory());
    source_.rewind();
    point_block block;
    std::vector<std::uint64_t> keys;
    std::uint64_t id = 0;
    while (source_.read(block, points_a_block)) {
        keys_.order_of(block, keys);
        for (const std::uint64_t key : keys) by_key.put(std::array{key, id++});
        pace_.show("scatter",
                   0.4 * static_cast<double>(id) / static_cast<double>(survey_.cloud.points));
    }
    row_writer by_rank(folder_.file(numbers_name), piece);
    std::uint64_t rank = 0;
    for (row_merge all = by_key.sorted(); !all.empty(); all.pop(), ++rank) {
        by_rank.put(all.front()[1]);
        ranks_->put(std::array{all.front()[1], rank});
        if (rank % points_a_block == 0) pace_.check();
    }
    numbers_ = by_rank.finish();
}

row_reader tile_steps::numbers_by_rank() const {
    return {folder_.file(numbers_name), numbers_, 1, piece};
}

void tile_steps::give_points() {
    const tile_cuts& cuts = *cuts_;
    std::vector<digest> digests(cuts.size());
    const auto flush = [&](std::size_t t, numbers rows) {
        const auto bytes = std::as_bytes(rows);
        append_to(file(t, ".points"), bytes);
        digests[t].add(bytes);
        tiles_[t].points.records += rows.size();
    };
    scattered rows(cuts.size(), static_cast<std::size_t>(std::min<std::uint64_t>(
                                    piece, task_.options.memory / 4 / cuts.size())));
    std::optional<row_merge> ranks;
    if (ranks_) ranks.emplace(ranks_->sorted());
    point_block block;
    std::vector<std::uint64_t> of_block;
    std::vector<std::uint32_t> halos;
    std::uint64_t id = 0;
    source_.rewind();
    while (source_.read(block, points_a_block)) {
        keys_.values_of(block, of_block);
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            const point3& p = block.points[i];
            std::uint64_t rank = id++;
            if (ranks && !ranks->empty()) {
                rank = ranks->front()[1];
                ranks->pop();
            }
            if (!base::is_finite(p)) continue;
            const numbers mine = numbers(of_block).subspan(i * values(), values());
            const std::uint32_t own = cuts.find(p, halos);
            ++tiles_[own].own;
            const tile_role role = halos.empty() ? tile_role::own : tile_role::shared;
            rows.put(own, tile_point::make(rank, role, p), mine, flush);
            for (const std::uint32_t t : halos)
                rows.put(t, tile_point::make(rank, tile_role::halo, p), mine, flush);
        }
        pace_.show("scatter", static_cast<double>(id) / static_cast<double>(survey_.cloud.points));
    }
    rows.finish(flush);
    ranks.reset();
    ranks_.reset();
    for (std::size_t t = 0; t < tiles_.size(); ++t) tiles_[t].points.digest = digests[t].value();
    check_points(id);
}

void tile_steps::check_points(std::uint64_t read) {
    std::uint64_t own = survey_.cloud.non_finite;
    for (const tile& t : tiles_) own += t.own;
    if (read == survey_.cloud.points && own == survey_.cloud.points) return;
    const std::filesystem::path& input = task_.inputs.paths.front();
    throw stream_error(stream_error::reason::input_changed, input,
                       input.string() + ": the file changed while it was read");
}

std::size_t tile_steps::at_a_time() const {
    std::uint64_t largest = 1;
    for (const tile& t : tiles_) largest = std::max(largest, points_of(t));
    const double room = 0.7 * static_cast<double>(task_.options.memory);
    const double each = static_cast<double>(largest * bytes_per_point() + 4 * piece);
    return static_cast<std::size_t>(std::clamp(room / each, 1.0, 64.0));
}

/// Tiles throw into their own slots, and those that come later are then left undone.
void tile_steps::weld_tiles() {
    pace_.show("weld", 0.0);
    std::mutex one_at_a_time;
    std::size_t finished = 0;
    const auto weld = [&](std::size_t t) {
        const bool before = tiles_[t].finished;
        if (!before) weld_tile(t);
        const std::lock_guard lock(one_at_a_time);
        tiles_[t].finished = true;
        if (!before) step_done();
        pace_.show("weld", static_cast<double>(++finished) / static_cast<double>(tiles_.size()));
    };
    const auto few = static_cast<unsigned>(at_a_time());
    if (few == 1) {  // threads are for what is inside
        for (std::size_t t = 0; t < tiles_.size(); ++t) weld(t);
        return;
    }
    std::vector<std::exception_ptr> thrown(tiles_.size());
    std::atomic<bool> failed = false;
    const thread_scope some(few);
    for_chunks(tiles_.size(), 1, [&](std::size_t t, std::size_t, std::size_t) {
        if (failed.load(std::memory_order_relaxed)) return;
        try {
            weld(t);
        } catch (...) {
            thrown[t] = std::current_exception();
            failed.store(true, std::memory_order_relaxed);
        }
    });
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

/// What a tile leaves, on its way to the disk.
struct tile_steps::tile_files {
    record_writer<tile_drop> dropped;
    row_writer border;
    record_writer<tile_member> members;
    std::unique_ptr<row_sorter> points{};  ///< in the order of ranks, where they have to be sorted
    weld::tile_result result{};

    void write() {
        dropped.put(result.dropped);
        const std::size_t width =
            result.border.empty() ? 0 : result.border_values.size() / result.border.size();
        for (std::size_t i = 0; i < result.border.size(); ++i) {
            border.put(row_of(result.border[i]));
            border.put(numbers(result.border_values).subspan(i * width, width));
        }
        members.put(result.members);
        result.dropped.clear();
        result.border.clear();
        result.border_values.clear();
        result.members.clear();
    }
};

/// Calls `take` with some points and their values at a time, by ascending ranks.
template <class Take>
void tile_steps::each_point_of(std::size_t t, const tile_files& files, const Take& take) const {
    unpacked some(point_width());
    if (!files.points) {
        record_reader<std::uint64_t> points(file(t, ".points"), tiles_[t].points, piece / 2,
                                            point_width());
        for (auto rows = points.next(); !rows.empty(); rows = points.next()) {
            some.put(rows);
            some.give(take);
            pace_.check();
        }
        return;
    }
    for (row_merge rows = files.points->sorted(); !rows.empty(); rows.pop()) {
        some.put(rows.front());
        if (some.size() < points_a_block / 2) continue;
        some.give(take);
        pace_.check();
    }
    some.give(take);
}

/// Points come in the order of the files.
void tile_steps::sort_points(std::size_t t, tile_files& files) const {
    files.points = std::make_unique<row_sorter>(folder_, std::to_string(t) + ".sorted",
                                                row_sorter::shape{point_width(), 1},
                                                sorting_memory() / at_a_time());
    row_reader points(file(t, ".points"), tiles_[t].points, point_width(), piece);
    for (; !points.empty(); points.pop()) files.points->put(points.front());
}

void tile_steps::weld_tile(std::size_t t) {
    tile& mine = tiles_[t];
    tile_files files{{file(t, ".drops"), piece / 4},
                     {file(t, ".border"), piece / 4},
                     {file(t, ".members"), piece / 4}};
    if (has_order()) sort_points(t, files);
    const std::uint64_t room = task_.options.memory / 10 * 7 / bytes_per_point();
    const bool held = rule() == weld_rule::first || points_of(mine) <= room;
    if (!held && values() > 0)
        fail_for_memory(task_.memory - task_.options.memory +
                        points_of(mine) * bytes_per_point() / 7 * 10 + piece);
    if (!held)
        weld_crowded(t, files);
    else
        weld_held(t, files);
    mine.drops = files.dropped.finish();
    mine.border = files.border.finish();
    mine.members = files.members.finish();
    mine.move = files.result.move;
    store_tile(t);
    std::filesystem::remove(file(t, ".points"));
}

void tile_steps::weld_held(std::size_t t, tile_files& files) {
    weld::tile_weld weld(rule(), tolerance_, keys_.agree());
    const std::uint64_t room = task_.options.memory / 2 / bytes_per_point();
    weld.reserve(static_cast<std::size_t>(std::min(points_of(tiles_[t]), room)));
    each_point_of(t, files, [&](std::span<const tile_point> points, numbers values) {
        weld.add(points, files.result, values);
        files.write();
    });
    for (bool more = true; more; files.write()) more = weld.finish(files.result);
}

/// \pre no conditions
void tile_steps::weld_crowded(std::size_t t, tile_files& files) {
    weld::crowded_chain weld(tolerance_);
    const auto each = [&](const auto& take) {
        each_point_of(t, files, [&](std::span<const tile_point> points, numbers) { take(points); });
    };
    each([&](auto points) { weld.look(points); });
    each([&](auto points) { weld.link(points); });
    each([&](auto points) {
        weld.settle(points, files.result);
        files.write();
    });
}

}  // namespace treeform::detail::stream
