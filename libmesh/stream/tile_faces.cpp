#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/tile_faces.hpp>
#include <libmesh/weld/carried_rows.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace treeform::detail::stream {
namespace {

const char* const renumbering_name = "new_numbers";
const char* const places_before_name = "places_before";
const char* const places_after_name = "places_after";

/// The corners of a face that grows, and whether it has one.
class grown_face {
  public:
    explicit grown_face(std::vector<std::uint32_t>& corners)
        : all_(corners), first_(corners.size()) {}

    void add(std::uint32_t corner) {
        all_.push_back(corner);
        if (!many_.empty()) many_.insert(corner);
    }
    [[nodiscard]] bool has(std::uint32_t corner) {
        constexpr std::ptrdiff_t few = 32;
        const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(first_);
        if (all_.end() - begin <= few) return std::find(begin, all_.end(), corner) != all_.end();
        if (many_.empty()) many_.insert(begin, all_.end());
        return many_.contains(corner);
    }

  private:
    std::vector<std::uint32_t>& all_;
    std::size_t first_;
    std::unordered_set<std::uint32_t> many_{};
};

/// A file of records, of which each rank has some.
template <class Record>
class records_of_all {
  public:
    records_of_all(const work_folder& folder, const communicator& all, const std::string& name)
        : all_(all),
          whole_(folder.file(name)),
          path_(all.is_root() ? whole_ : folder.file(name + "." + std::to_string(all.rank()))),
          writer_(path_, piece) {}

    void put(const Record& record) { writer_.put(record); }
    /// Collective: every rank must call this. Returns how many there are.
    std::uint64_t finish() {
        const std::uint64_t mine = writer_.finish_unsynced().records;
        state_writer sent;
        sent.number(mine);
        std::uint64_t all = 0;
        std::uint64_t before = 0;
        std::vector<state_reader> counts = all_.exchange(sent);
        for (std::size_t r = 0; r < counts.size(); ++r) {
            if (r == all_.rank()) before = all;
            all += counts[r].number();
        }
        if (!all_.is_root()) {
            copy_bytes(path_, 0, whole_, before * sizeof(Record), mine * sizeof(Record));
            std::filesystem::remove(path_);
        }
        all_.barrier();
        return all;
    }

  private:
    const communicator& all_;
    std::filesystem::path whole_;
    std::filesystem::path path_;
    record_writer<Record> writer_;
};

}  // namespace

tile_faces::~tile_faces() {
    if (!steps_.all().is_root()) return;
    std::error_code ignored;
    for (const char* name : {renumbering_name, places_before_name, places_after_name})
        std::filesystem::remove(folder_.file(name), ignored);
}

io_error tile_faces::changed() const {
    const std::filesystem::path& input = task_.inputs.paths.front();
    return io_error(io_error::kind::input_changed, input,
                    input.string() + ": the file changed while it was read");
}

template <class Take>
void tile_faces::each_block(bool whole, const Take& take) {
    io::point_blocks reader = open();
    const bool in_parts = !parts_.empty();
    const std::size_t first = whole ? 0 : steps_.all().rank();
    const std::size_t last = whole ? steps_.all().size() : first + 1;
    if (in_parts) reader.go_to(parts_[first]);
    std::uint64_t left =
        in_parts ? parts_[last].row - parts_[first].row : std::numeric_limits<std::uint64_t>::max();
    row_block block;
    while (left > 0 && reader.read(block, rows_of_next(left, rows_at_once_))) {
        left -= block.rows.rows + block.left_out;
        take(block);
        pace_.check();
    }
    if (in_parts && left > 0) throw changed();
}

/// Each rank does it for its points; and looks at the facets of a soup that begin with one.
void tile_faces::number_points(tiles_welded& welded, kept_rows* rows, bool has_moves) {
    const communicator& all = steps_.all();
    const share& mine = welded.points;
    new_numbers renumbered(pace_, folder_, all, steps_, welded);
    joined_points& source = steps_.source();
    share corners = mine;
    if (is_soup_) corners.last = (mine.last + 2) / 3 * 3;
    source.rewind(corners);
    if (rows != nullptr) rows->rewind();
    records_of_all<std::uint64_t> renumbering(folder_, all, renumbering_name);
    std::optional<records_of_all<point3>> before;
    std::optional<records_of_all<point3>> after;
    if (has_moves) before.emplace(folder_, all, places_before_name);
    if (has_moves) after.emplace(folder_, all, places_after_name);
    std::uint64_t point = mine.first;
    for (io::point_block block; source.read(block, points_a_block); pace_.check()) {
        if (is_soup_) look_at_corners(block, point);
        for (std::size_t i = 0; i < block.points.size() && point < mine.last; ++i, ++point) {
            if (before) before->put(block.points[i]);
            renumbering.put(renumbered.of(point));
            if (!after || !welded.kept.keeps(point)) continue;
            if (rows != nullptr && !welded.followed->keeps(point)) rows->replace(block, i);
            after->put(block.points[i]);
        }
    }
    renumbering.finish();
    if (before) before->finish();
    if (after) kept_places_ = after->finish();
}

void tile_faces::open_numbers() {
    if (!numbers_)
        numbers_.emplace(folder_.file(renumbering_name), steps_.survey().points,
                         task_.options.memory / 4);
}

/// Of a soup, as of what `weld` looks at: equal corners are one. The block begins with `point`.
void tile_faces::look_at_corners(const io::point_block& block, std::uint64_t point) {
    std::vector<point3>& held = corners_of_soup_;
    for (const point3& p : block.points) {
        const bool begins = point++ % 3 == 0;
        if (held.empty() && !begins) continue;  // its facet began with a point of another
        held.push_back(p);
        if (held.size() < 3) continue;
        const auto equal = [&](std::size_t i, std::size_t j) {
            return held[i] == held[j] && base::is_finite(held[i]);
        };
        if (equal(0, 1) || equal(1, 2) || equal(2, 0)) {
            ++made_.statistics.degenerate;
        } else {
            // No other face has a corner that is not finite.
            for (std::size_t k = 0; k < 3; ++k)
                if (const point3& to = held[k == 2 ? 0 : k + 1];
                    base::is_finite(held[k]) && base::is_finite(to))
                    edges_of_soup_->put(edge_between(held[k], to));
        }
        held.clear();
    }
}

void tile_faces::weld(tiles_welded& welded, kept_rows* rows, weld_stream_result& made) {
    made_ = made;
    const std::uint64_t uses = 3 * steps_.survey().triangles;
    const std::uint64_t memory = task_.options.memory / 8;
    const communicator& all = steps_.all();
    if (is_soup_)
        edges_of_soup_.emplace(folder_, all, "edges_before", uses, memory);
    else
        edges_before_.emplace(folder_, all, "edges_before", uses, memory);
    number_points(welded, rows, made.statistics.max_displacement > 0.0);
    steps_.step_done();
    edges_after_.emplace(folder_, all, "edges_after", uses, memory);
    carry_all();
    share_counts();
    made = made_;
    steps_.step_done();
}

void tile_faces::carry_all() {
    open_numbers();
    if (made_.statistics.max_displacement > 0.0) {
        const std::uint64_t memory = task_.options.memory / 8;
        before_.emplace(folder_.file(places_before_name), steps_.survey().points, memory);
        after_.emplace(folder_.file(places_after_name), kept_places_, memory);
    }
    counts_now_ = true;
    row_block carried;
    each_block(false, [&](const row_block& block) {
        if (block.rows.name != "face") return;
        carry(block, carried);
        made_.faces += carried.rows.rows;
        most_kept_corners_ = std::max(most_kept_corners_, longest_face(carried));
    });
    counts_now_ = false;
    before_.reset();
    after_.reset();
    places_before_ = {};
    places_after_ = {};
    made_.statistics.nonmanifold_before = is_soup_ ? edges_of_soup_->count_nonmanifold(pace_)
                                                   : edges_before_->count_nonmanifold(pace_);
    edges_of_soup_.reset();
    edges_before_.reset();
    made_.statistics.nonmanifold_after = edges_after_->count_nonmanifold(pace_);
    edges_after_.reset();
}

/// Sums up what all have counted, of which edges are of all already.
void tile_faces::share_counts() {
    const std::array counted{&made_.faces, &made_.triangles, &made_.statistics.collapsed,
                             &made_.statistics.degenerate, &made_.statistics.flipped};
    state_writer mine;
    for (std::uint64_t* n : counted) mine.number(std::exchange(*n, 0));
    mine.number(most_kept_corners_);
    for (state_reader& one : steps_.all().exchange(mine)) {
        for (std::uint64_t* n : counted) *n += one.number();
        most_kept_corners_ = std::max(most_kept_corners_, static_cast<std::size_t>(one.number()));
    }
    if (is_soup_) made_.statistics.collapsed -= made_.statistics.degenerate;  // those collapse, too
}

/// As `weld` and `rejoin_polygons` do in memory: of the fans of polygons, triangles that collapse
/// are left out, and the others are polygons again where they are still one fan.
void tile_faces::carry(const row_block& from, row_block& to) {
    rows_.clear();
    to.corners.clear();
    to.first_corner.assign(1, 0);
    look_up(from.corners);
    for (std::uint32_t f = 0; f < from.rows.rows; ++f) carry_face(from, f, to);
    to.rows = from.rows.gathered(rows_);
}

void tile_faces::look_up(std::span<const std::uint32_t> corners) {
    constexpr std::uint64_t bytes_a_row = 300;
    numbers_->look_up(corners, corners_);
    bool scattered = numbers_->is_scattered();
    if (before_) {
        before_->look_up(corners, places_before_);
        after_->look_up(corners_, places_after_);
        scattered = scattered || before_->is_scattered() || after_->is_scattered();
    }
    const std::uint64_t most = scattered ? task_.options.memory / 8 / bytes_a_row : 0;
    rows_at_once_ = std::max(rows_a_block, static_cast<std::size_t>(most));
}

void tile_faces::carry_face(const row_block& from, std::uint32_t row, row_block& to) {
    const auto first = static_cast<std::size_t>(from.first_corner[row]);
    const auto end = static_cast<std::size_t>(from.first_corner[row + 1]);
    const std::vector<std::uint32_t>& corners = from.corners;
    std::optional<grown_face> grown;
    std::size_t last = first;  // corner of the triangle before
    for (std::size_t i = first + 2; i < end; ++i) {
        const face after{corners_[first], corners_[i - 1], corners_[i]};
        if (!is_kept({corners[first], corners[i - 1], corners[i]}, after, {first, i - 1, i}))
            continue;
        const bool continues = grown && after[1] == corners_[last] &&
                               (task_.options.keep_degenerate || !grown->has(after[2]));
        if (continues) {
            grown->add(after[2]);
        } else {
            if (grown) to.first_corner.push_back(to.corners.size());
            rows_.push_back(row);
            grown.emplace(to.corners);
            for (const std::uint32_t corner : after) grown->add(corner);
        }
        last = i;
    }
    if (grown) to.first_corner.push_back(to.corners.size());
}

bool tile_faces::is_kept(const face& before, const face& after, const corners_of_block& at) {
    const bool was_whole = base::has_three_corners(before);
    const bool is_whole = base::has_three_corners(after);
    const bool kept = is_whole || task_.options.keep_degenerate;
    if (!counts_now_) return kept;
    if (!is_whole) ++(was_whole ? made_.statistics.collapsed : made_.statistics.degenerate);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = k == 2 ? 0 : k + 1;
        if (was_whole && edges_before_) edges_before_->put(edge_between(before[k], before[next]));
        if (is_whole) edges_after_->put(edge_between(after[k], after[next]));
    }
    if (!kept) return false;
    ++made_.triangles;
    if (before_ && is_flipped(at)) ++made_.statistics.flipped;
    return true;
}

bool tile_faces::is_flipped(const corners_of_block& at) const {
    const auto places = [&](const std::vector<point3>& of) {
        return plane_points{of[at[0]], of[at[1]], of[at[2]]};
    };
    return weld::is_flipped(places(places_before_), places(places_after_));
}

void tile_faces::renumber(row_block& block) {
    const std::uint64_t points = steps_.survey().points;
    for (column& c : block.rows.columns)
        if (weld::numbers_points(c))
            weld::renumber(c, 0, c.size(), points,
                           [&](std::uint64_t old) { return number_of(old); });
}

void tile_faces::describe(mesh_file& head, bool all) const {
    for (element& e : head.attributes.elements) {
        if (e.name != "face" || e.rows == 0) continue;
        e.rows = static_cast<std::size_t>(all ? steps_.survey().faces : made_.faces);
        drop_blank(e);
    }
    if (is_blank_)
        std::erase_if(head.attributes.elements,
                      [](const element& e) { return e.name == "face" && e.rows == 0; });
}

/// In memory, a soup has a column only where a value is not zero, and without it no element where
/// no face is left.
void tile_faces::drop_blank(element& faces) const {
    if (is_blank_) faces.columns.clear();
}

void tile_faces::give(point_writer& to, bool all, bool whole) {
    open_numbers();
    row_block carried;
    std::uint64_t faces = 0;
    each_block(whole, [&](row_block& block) {
        if (block.rows.name == "face") drop_blank(block.rows);
        if (all) return to.write(block);
        if (block.rows.name == "face") {
            carry(block, carried);
            faces += carried.rows.rows;
            if (carried.rows.rows > 0) to.write(carried);
            return;
        }
        renumber(block);
        to.write(block);
    });
    if (!whole && !all && steps_.all().sum(faces) != made_.faces) throw changed();
}

}  // namespace treeform::detail::stream
