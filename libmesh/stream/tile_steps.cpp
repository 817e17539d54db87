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
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

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
            points_.push_back({rows[0], point_of(rows)});
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

tile_steps::tile_steps(cancellable_progress& pace, const work_folder& folder, const tile_task& task,
                       const communicator& all, joined_points& source, const point_keys& keys)
    : pace_(pace), folder_(folder), task_(task), communicator_(all), source_(source), keys_(keys) {}

void tile_steps::step_done() const {
    if (task_.options.step_done) task_.options.step_done();
}

std::filesystem::path tile_steps::file(std::size_t t, const char* what) const {
    return folder_.file(std::to_string(t) + what);
}

bool tile_steps::by_chain() const {
    const bool chains_of_equal_points = !keys_.agree().is_transitive();
    return task_.options.chain && (task_.options.tolerance > 0.0 || chains_of_equal_points);
}

std::uint64_t tile_steps::bytes_per_point() const {
    const std::uint64_t of_values = values() > 0 ? 8 * values() + 12 : 0;
    return (!by_chain() ? 104 : 110) + of_values;
}

std::size_t tile_steps::bytes_per_reader() const {
    const std::uint64_t share = task_.options.memory / 16 / (tiles_.size() + 1);
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(share, 4096, piece));
}

void tile_steps::set_tolerance() {
    const std::optional<box3>& box = survey_.cloud.box;
    const double share = task_.options.relative ? (box ? box->diagonal() : 0.0) : 1.0;
    tolerance_ = share * task_.options.tolerance;
    survey_.cloud.tolerance = tolerance_;
}

std::uint64_t tile_steps::points_of(const tile& t) const {
    std::uint64_t sum = 0;
    for (const record_count& part : t.points) sum += part.records;
    return sum / point_width();
}

std::filesystem::path tile_steps::points_file(std::size_t t, std::size_t part) const {
    return file(t, ".points").string() + (part == 0 ? "" : "." + std::to_string(part));
}

share tile_steps::read_by(std::size_t rank) const {
    if (communicator_.is_alone()) return {};
    return communicator_.share_of(source_.count(), rank);
}

share tile_steps::tiles_of(std::size_t rank, bool unfinished) const {
    const auto weight_of = [&](const tile& t) {
        return unfinished && t.finished ? 0 : points_of(t);
    };
    std::uint64_t all = 1;
    for (const tile& t : tiles_) all += weight_of(t);
    share mine{0, 0};
    std::uint64_t before = 0;
    for (const tile& t : tiles_) {
        const std::uint64_t middle = before + weight_of(t) / 2;
        const auto owner =
            static_cast<std::size_t>(static_cast<double>(communicator_.size()) *
                                     static_cast<double>(middle) / static_cast<double>(all));
        mine.first += owner < rank ? 1 : 0;
        mine.last += owner <= rank ? 1 : 0;
        before += weight_of(t);
    }
    return mine;
}

void tile_steps::say_plan() {
    cloud_survey& cloud = survey_.cloud;
    cloud.conditions = keys_.conditions();
    cloud.tiles = cuts_->size();
    if (!tiles_.empty()) return;
    // Tiles' points are removed as their drops are written, which take half as much at most.
    // Borders and members, few mostly, are not counted.
    cloud.disk_bytes = cloud.points * (8 * point_width() + 2 + (has_order() ? 48 : 0));
    const std::uint64_t there = unpacked_ ? unpacked_->bytes() : 0;
    cloud.disk_bytes += there;
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (!unknown) cloud.disk_bytes_free = space.available + there;
}

void tile_steps::scatter() {
    if (scattered_) return;
    survey_.sample = {};
    survey_.places.reset();
    tiles_.assign(cuts_->size(), {});
    if (has_order()) rank_points();
    give_points();
    scattered_ = true;
    count_finished();
    if (communicator_.is_root()) store_plan();
    communicator_.barrier();
    step_done();
}

void tile_steps::give_points() {
    const tile_cuts& cuts = *cuts_;
    std::vector<digest> digests(cuts.size());
    std::vector<record_count> given(cuts.size());
    const auto flush = [&](std::size_t t, numbers rows) {
        const auto bytes = std::as_bytes(rows);
        append_to(points_file(t, communicator_.rank()), bytes);
        digests[t].add(bytes);
        given[t].records += rows.size();
    };
    scattered rows(cuts.size(), static_cast<std::size_t>(std::min<std::uint64_t>(
                                    piece, task_.options.memory / 4 / cuts.size())));
    const share mine = read_by(communicator_.rank());
    std::optional<row_reader> ranks;
    if (has_order()) ranks.emplace(ranks_file(), ranks_, 1, piece);
    io::point_block block;
    std::vector<std::uint64_t> of_block;
    std::vector<std::uint32_t> halos;
    std::uint64_t id = mine.first;
    source_.rewind(mine);
    while (source_.read(block, points_a_block)) {
        keys_.values_of(block, of_block);
        for (std::size_t i = 0; i < block.points.size(); ++i) {
            const point3& p = block.points[i];
            std::uint64_t rank = id++;
            if (ranks && !ranks->empty()) {
                rank = ranks->front()[0];
                ranks->pop();
            }
            if (!base::is_finite(p)) continue;
            const numbers values_of_point = numbers(of_block).subspan(i * values(), values());
            const std::uint32_t own = cuts.find(p, halos);
            ++tiles_[own].own;
            const tile_role role = halos.empty() ? tile_role::own : tile_role::shared;
            rows.put(own, tile_point::make(rank, role, p), values_of_point, flush);
            for (const std::uint32_t t : halos)
                rows.put(t, tile_point::make(rank, tile_role::halo, p), values_of_point, flush);
        }
        pace_.show("scatter",
                   static_cast<double>(id - mine.first) /
                       static_cast<double>(survey_.cloud.points / communicator_.size() + 1));
    }
    rows.finish(flush);
    if (has_order()) std::filesystem::remove(ranks_file());
    for (std::size_t t = 0; t < given.size(); ++t) given[t].digest = digests[t].value();
    share_counts(id - mine.first, given);
}

/// What all have read, and given to each tile.
void tile_steps::share_counts(std::uint64_t read, const std::vector<record_count>& given) {
    state_writer mine;
    mine.number(read);
    for (std::size_t t = 0; t < given.size(); ++t) {
        store_count(given[t], mine);
        mine.number(tiles_[t].own);
        tiles_[t].own = 0;
    }
    std::uint64_t all = 0;
    std::uint64_t own = survey_.cloud.non_finite;
    for (state_reader& one : communicator_.exchange(mine)) {
        all += one.number();
        for (tile& t : tiles_) {
            t.points.push_back(load_count(one));
            t.own += one.number();
        }
    }
    for (const tile& t : tiles_) own += t.own;
    if (all == survey_.cloud.points && own == survey_.cloud.points) return;
    const std::filesystem::path& input = task_.inputs.paths.front();
    throw io_error(io_error::kind::input_changed, input,
                   input.string() + ": the file changed while it was read");
}

std::uint64_t tile_steps::most_points() const {
    std::uint64_t most = 0;
    for (const tile& t : tiles_) most = std::max(most, points_of(t));
    return most;
}

std::size_t tile_steps::at_a_time() const {
    const std::uint64_t largest = std::max<std::uint64_t>(most_points(), 1);
    const double room = 0.7 * static_cast<double>(task_.options.memory);
    const double each = static_cast<double>(largest * bytes_per_point() + 4 * piece);
    return static_cast<std::size_t>(std::clamp(room / each, 1.0, 64.0));
}

/// Tiles throw into their own slots, and those that come later are then left undone.
void tile_steps::weld_tiles() {
    pace_.show("weld", 0.0);
    const share mine = tiles_of(communicator_.rank(), true);
    const auto count = static_cast<std::size_t>(mine.size());
    std::mutex one_at_a_time;
    std::size_t finished = 0;
    const auto weld = [&](std::size_t i) {
        const std::size_t t = static_cast<std::size_t>(mine.first) + i;
        const bool before = tiles_[t].finished;
        if (!before) weld_tile(t);
        const std::lock_guard lock(one_at_a_time);
        if (!before) step_done();
        pace_.show("weld", static_cast<double>(++finished) / static_cast<double>(count));
    };
    const auto few = static_cast<unsigned>(at_a_time());
    if (few == 1) {  // threads are for what is inside
        for (std::size_t i = 0; i < count; ++i) weld(i);
    } else {
        std::vector<std::exception_ptr> thrown(count);
        std::atomic<bool> failed = false;
        const thread_scope some(few);
        for_chunks(count, 1, [&](std::size_t i, std::size_t, std::size_t) {
            if (failed.load(std::memory_order_relaxed)) return;
            try {
                weld(i);
            } catch (...) {
                thrown[i] = std::current_exception();
                failed.store(true, std::memory_order_relaxed);
            }
        });
        for (const std::exception_ptr& error : thrown)
            if (error) std::rethrow_exception(error);
    }
    communicator_.barrier();
    check_finished();
}

void tile_steps::weld_one(std::size_t t) {
    if (t >= tiles_.size())
        throw std::out_of_range("treeform::shared_weld: tile " + std::to_string(t) + " of " +
                                std::to_string(tiles_.size()));
    pace_.show("weld", 0.0);
    if (!find_tile(t, true)) folder_.fail_with_other_tiles();
    if (tiles_[t].finished) return;
    check_before_tile();
    weld_tile(t);
    step_done();
}

std::vector<std::size_t> tile_steps::unfinished() {
    std::vector<std::size_t> missing;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        if (task_.options.shared ? !load_tile(t, true)
                                 : !tiles_[t].finished && !load_tile(t, false))
            missing.push_back(t);
    return missing;
}

void tile_steps::check_finished() {
    const std::vector<std::size_t> missing = unfinished();
    if (!missing.empty()) folder_.fail_unfinished(missing);
}

/// What a tile leaves, on its way to the disk.
struct tile_steps::tile_files {
    record_writer<tile_drop> dropped;
    row_writer border;
    row_writer asked;
    record_writer<tile_member> members;
    std::unique_ptr<row_sorter> points{};  ///< in the order of ranks, where they have to be sorted
    weld::tile_result result{};

    void write() {
        dropped.put(result.dropped);
        put_border(result, border);
        put_asked(result, [&](const asked_point& a, numbers values) {
            asked.put(row_of(a));
            asked.put(values);
        });
        members.put(result.members);
        result.dropped.clear();
        result.members.clear();
    }
};

std::uint64_t tile_steps::put_border(weld::tile_result& result, row_writer& to) {
    const std::size_t width =
        result.border.empty() ? 0 : result.border_values.size() / result.border.size();
    std::uint64_t rows = 0;
    for (std::size_t i = 0; i < result.border.size(); ++i)
        rows +=
            put_rows(result.border[i], numbers(result.border_values).subspan(i * width, width), to);
    result.border.clear();
    result.border_values.clear();
    return rows;
}

/// Calls `take` with some rows at a time, in the order of the files.
template <class Take>
void tile_steps::each_row_of(std::size_t t, const Take& take) const {
    for (std::size_t r = 0; r < tiles_[t].points.size(); ++r) {
        if (tiles_[t].points[r].records == 0) continue;
        record_reader<std::uint64_t> points(points_file(t, r), tiles_[t].points[r], piece / 2,
                                            point_width());
        for (auto rows = points.next(); !rows.empty(); rows = points.next()) {
            take(rows);
            pace_.check();
        }
    }
}

/// Calls `take` with some points and their values at a time, by ascending ranks.
template <class Take>
void tile_steps::each_point_of(std::size_t t, const tile_files& files, const Take& take) const {
    unpacked some(point_width());
    if (!files.points)
        return each_row_of(t, [&](numbers rows) {
            some.put(rows);
            some.give(take);
        });
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
    files.points = std::make_unique<row_sorter>(
        folder_, work_folder::own_name(std::to_string(t) + ".sorted"),
        row_sorter::shape{point_width(), 1}, sorting_memory() / at_a_time());
    each_row_of(t, [&](numbers rows) {
        for (; !rows.empty(); rows = rows.subspan(point_width()))
            files.points->put(rows.first(point_width()));
    });
}

void tile_steps::weld_tile(std::size_t t) {
    tile& mine = tiles_[t];
    const std::array names{std::to_string(t) + ".drops", std::to_string(t) + ".border",
                           std::to_string(t) + ".asked", std::to_string(t) + ".members"};
    std::array<std::string, 4> own;  // until all is written
    std::ranges::transform(names, own.begin(), work_folder::own_name);
    tile_files files{{folder_.file(own[0]), piece / 4},
                     {folder_.file(own[1]), piece / 4},
                     {folder_.file(own[2]), piece / 4},
                     {folder_.file(own[3]), piece / 4}};
    if (has_order()) sort_points(t, files);
    // More than is planned for: the plan knows samples only.
    const std::uint64_t room = task_.options.memory / 10 * 8 / bytes_per_point();
    const bool held = !by_chain() || points_of(mine) <= room;
    if (!held && values() > 0) fail_for_memory(needs_of_one_tile(most_points()).tiles);
    if (!held)
        weld_crowded(t, files);
    else
        weld_held(t, files);
    mine.drops = files.dropped.finish();
    mine.border = files.border.finish();
    mine.asked = files.asked.finish();
    mine.members = files.members.finish();
    mine.move = files.result.move;
    for (std::size_t i = 0; i < names.size(); ++i) folder_.rename(own[i], names[i]);
    store_tile(t);
    mine.finished = true;
    if (task_.options.shared) return;  // others may weld it, too
    for (std::size_t r = 0; r < mine.points.size(); ++r) std::filesystem::remove(points_file(t, r));
}

void tile_steps::weld_held(std::size_t t, tile_files& files) {
    weld::tile_weld weld(by_chain(), tolerance_, keys_.agree(), slices());
    // With the rule first few are held; or all, which doubles memory twice, up to
    // `bytes_per_point`. Of a crowded tile it is few, however many points it has.
    constexpr std::uint64_t most = std::uint64_t{1} << 17;
    const std::uint64_t all = points_of(tiles_[t]);
    weld.reserve(static_cast<std::size_t>(!by_chain() ? std::min(all / 4, most) : all));
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
    each([&](auto points) { weld.find_cubes(points); });
    each([&](auto points) { weld.link_cubes(points); });
    each([&](auto points) {
        weld.append_result(points, files.result);
        files.write();
    });
}

}  // namespace treeform::detail::stream
