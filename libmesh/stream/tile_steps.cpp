#include <libmesh/base/point_math.hpp>
#include <libmesh/stream/tile_steps.hpp>
#include <libmesh/weld/crowded_chain.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>

namespace treeform::detail::stream {
namespace {

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

}  // namespace

tile_steps::tile_steps(pacer& pace, const work_folder& folder, const tile_task& task)
    : pace_(pace), folder_(folder), task_(task) {}

void tile_steps::step_done() const {
    if (task_.options.step_done) task_.options.step_done();
}

std::filesystem::path tile_steps::file(std::size_t t, const char* what) const {
    return folder_.file(std::to_string(t) + what);
}

weld_rule tile_steps::rule() const {
    return tolerance_ > 0.0 ? task_.options.rule : weld_rule::first;
}

std::uint64_t tile_steps::bytes_per_point() const { return rule() == weld_rule::first ? 64 : 110; }

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
    cloud.tiles = slabs_ ? slabs_->size() : tiles_.size();
    if (!slabs_) return;
    // Tiles' points are removed as their drops are written, which take half as much at most.
    // Members, few mostly, are not counted.
    cloud.disk_bytes = cloud.points * (sizeof(tile_point) + 2);
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (!unknown) cloud.disk_bytes_free = space.available;
}

void tile_steps::scatter() {
    if (!slabs_) return;
    survey_.sample = {};
    tiles_.resize(slabs_->size());
    give_points();
    slabs_.reset();
    store_plan();
    step_done();
}

void tile_steps::give_points() {
    const tile_slabs& slabs = *slabs_;
    point_reader reader(task_.input, task_.options.format);
    std::vector<digest> digests(slabs.size());
    const auto flush = [&](std::size_t t, const std::vector<tile_point>& row) {
        const auto bytes = std::as_bytes(std::span(row));
        append_to(file(t, ".points"), bytes);
        digests[t].add(bytes);
        tiles_[t].points.records += row.size();
    };
    scattered rows(slabs.size(), static_cast<std::size_t>(std::min<std::uint64_t>(
                                     piece, task_.options.memory / 4 / slabs.size())));
    const cloud_survey& cloud = survey_.cloud;
    point_block block;
    std::uint64_t id = 0;
    while (reader.read(block, points_a_block)) {
        for (const point3& p : block.points) {
            const std::uint64_t mine = id++;
            if (!base::is_finite(p)) continue;
            const auto place = slabs.find(p);
            ++tiles_[place.own].own;
            for (std::uint32_t t = place.first; t <= place.last; ++t) {
                const tile_role role = t != place.own              ? tile_role::halo
                                       : place.first == place.last ? tile_role::own
                                                                   : tile_role::shared;
                rows.put(t, tile_point::make(mine, role, p), flush);
            }
        }
        pace_.show("scatter", static_cast<double>(id) / static_cast<double>(cloud.points));
    }
    rows.finish(flush);

    std::uint64_t own = cloud.non_finite;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        tiles_[t].points.digest = digests[t].value();
        own += tiles_[t].own;
    }
    if (id != cloud.points || own != cloud.points)
        throw weld_stream_error(weld_stream_error::reason::input_changed, task_.input,
                                task_.input.string() + ": the file changed while it was read");
}

std::size_t tile_steps::at_a_time() const {
    std::uint64_t largest = 1;
    for (const tile& t : tiles_) largest = std::max(largest, t.points.records);
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
    record_writer<border_point> border;
    record_writer<tile_member> members;
    weld::tile_result result{};

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
        pace_.check();
    }
}

void tile_steps::weld_tile(std::size_t t) {
    tile& mine = tiles_[t];
    tile_files files{{file(t, ".drops"), piece / 4},
                     {file(t, ".border"), piece / 4},
                     {file(t, ".members"), piece / 4}};
    const std::uint64_t room = task_.options.memory / 10 * 7 / bytes_per_point();
    if (rule() == weld_rule::chain && mine.points.records > room)
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
    weld::tile_weld weld(rule(), tolerance_);
    const std::uint64_t room = task_.options.memory / 2 / bytes_per_point();
    weld.reserve(static_cast<std::size_t>(std::min(tiles_[t].points.records, room)));
    each_point_of(t, [&](auto row) {
        weld.add(row, files.result);
        files.write();
    });
    for (bool more = true; more; files.write()) more = weld.finish(files.result);
}

void tile_steps::weld_crowded(std::size_t t, tile_files& files) {
    weld::crowded_chain weld(tolerance_);
    each_point_of(t, [&](auto row) { weld.look(row); });
    each_point_of(t, [&](auto row) { weld.link(row); });
    each_point_of(t, [&](auto row) {
        weld.settle(row, files.result);
        files.write();
    });
}

}  // namespace treeform::detail::stream
