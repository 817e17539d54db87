#include <libmesh/base/add_to_box.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/stream/point_places.hpp>
#include <libmesh/stream/rows_in_turn.hpp>
#include <libmesh/stream/tile_search.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t triangles_a_block = std::size_t{1} << 16;
constexpr std::uint64_t bytes_a_face = 250;                    // that `search` holds, by measure
constexpr std::uint64_t base_bytes = std::uint64_t{48} << 20;  // the program, threads and code
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

/// `make_store` as for PLY.
io::face_rows open_faces(
    const io::source& in, const std::filesystem::path& path, const std::string& format,
    const std::function<std::unique_ptr<io::point_store>(std::size_t)>& make_store,
    const io::file_part& part, const io::record_index* known) {
    const auto found = io::detect(in, io::plain_extension(format), io::extension_of(path));
    if (found.kind == io::file_kind::stl_binary) return io::open_stl_faces(in, part);
    if (found.kind == io::file_kind::ply) return io::open_ply_faces(in, make_store, part, known);
    in.fail("only binary STL and PLY are searched in tiles");
}

std::unique_ptr<io::point_store> place_for(std::size_t points, const io::source& in,
                                           const work_folder& folder, std::uint64_t memory) {
    try {
        return std::make_unique<placed_points>(
            std::make_unique<io::scratch>(points * sizeof(point3), io::scratch_place::file,
                                          in.name(), folder.path()),
            memory);
    } catch (const io_error& error) {  // not of the input
        throw io_error(io_error::kind::tile_write, folder.path(), error.what());
    }
}

template <class Real>
tile_face<Real> record_of(const io::placed_triangle& t, std::uint64_t number) {
    tile_face<Real> record{.triangle = static_cast<std::uint32_t>(number), .stored = t.stored};
    for (std::size_t c = 0; c < 3; ++c) {
        record.corners[c] = t.corners[c];
        for (std::size_t k = 0; k < 3; ++k) record.at[3 * c + k] = static_cast<Real>(t.at[c][k]);
    }
    return record;
}

template <class Real>
point3 corner_of(const tile_face<Real>& f, std::size_t c) {
    return {f.at[3 * c], f.at[3 * c + 1], f.at[3 * c + 2]};
}

/// The faces as a mesh, which has each point once a corner, or once a number.
template <class Real>
mesh mesh_of(const std::vector<tile_face<Real>>& faces, vertex_identity vertices) {
    mesh m;
    m.points.reserve(3 * faces.size());
    m.faces.reserve(faces.size());
    for (const tile_face<Real>& f : faces) {
        const auto first = static_cast<std::uint32_t>(m.points.size());
        for (std::size_t c = 0; c < 3; ++c) m.points.push_back(corner_of(f, c));
        m.faces.push_back({first, first + 1, first + 2});
    }
    if (vertices == vertex_identity::by_coordinates) return join_equal_points(m);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(3 * faces.size());
    for (const tile_face<Real>& f : faces)
        numbers.insert(numbers.end(), f.corners.begin(), f.corners.begin() + 3);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    std::vector<point3> points(numbers.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = std::lower_bound(numbers.begin(), numbers.end(), faces[i].corners[c]);
            m.faces[i][c] = static_cast<std::uint32_t>(at - numbers.begin());
            points[m.faces[i][c]] = corner_of(faces[i], c);
        }
    m.points = std::move(points);
    return m;
}

/// The lowest corner of what the boxes of two faces have in common. \pre they have something
point3 lowest_common(mesh_view m, const face_pair& pair) {
    point3 lowest;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto low = [&](std::uint32_t f) {
            const auto& [a, b, c] = m.faces[f];
            return std::min({m.points[a][k], m.points[b][k], m.points[c][k]});
        };
        lowest[k] = std::max(low(pair.a), low(pair.b));
    }
    return lowest;
}

template <class Record>
std::vector<Record> all_of(const std::filesystem::path& path, const record_count& count) {
    std::vector<Record> records;
    records.reserve(static_cast<std::size_t>(count.records));
    record_reader<Record> reader(path, count, piece_bytes);
    for (auto row = reader.next(); !row.empty(); row = reader.next())
        records.insert(records.end(), row.begin(), row.end());
    return records;
}

void add_counts(face_pair_result& sum, const face_pair_result& one) {
    for (std::size_t k = 0; k < pair_kind_count; ++k) sum.counts[k] += one.counts[k];
    sum.box_pairs += one.box_pairs;
    sum.exact_pairs += one.exact_pairs;
    sum.predicates += one.predicates;
}

}  // namespace

tile_search::tile_search(cancellable_progress& pace, const work_folder& folder,
                         const communicator& of, std::filesystem::path input,
                         file_search_options options)
    : pace_(pace),
      folder_(folder),
      all_(of),
      input_(std::move(input)),
      options_(std::move(options)) {
    const std::uint64_t all =
        options_.memory == 0 ? weld_stream_options::default_memory() : options_.memory;
    memory_ = all - std::min(base_bytes, all / 2);
}

std::filesystem::path tile_search::file(std::size_t tile, const char* what) const {
    return folder_.file(std::to_string(tile) + what);
}

std::filesystem::path tile_search::faces_file(std::size_t tile, std::size_t part) const {
    return file(tile, ".faces").string() + (part == 0 ? "" : "." + std::to_string(part));
}

void tile_search::drop_faces(std::size_t tile) const {
    for (std::size_t r = 0; r < faces_[tile].size(); ++r)
        std::filesystem::remove(faces_file(tile, r));
}

/// With room for tiles that are larger than the sample said, and some tiles for each rank.
std::size_t tile_search::tile_count(std::uint64_t faces) const {
    std::uint64_t most = options_.faces_per_tile;
    if (most == 0) {
        most = memory_ / 3 * 2 / bytes_a_face;
        if (!all_.is_alone()) most = std::min(most, faces / (8 * all_.size()));
        most = std::max<std::uint64_t>(most, 1000);
    }
    return static_cast<std::size_t>(faces / most + 1);
}

void tile_search::scatter() {
    const bool had_plan = has_plan();
    if (all_.sum(has_tiles() ? 0 : 1) == 0) return;
    forget_tiles();
    if (all_.is_root()) folder_.clear();
    all_.barrier();
    try {
        if (!give_tiles(false)) static_cast<void>(give_tiles(true));
        survey_.started_anew = had_plan;
        check_memory();
        if (all_.is_root()) store_plan();
        all_.barrier();
    } catch (...) {  // half of the faces are of no use
        forget_tiles();
        if (all_.is_root() && !others_read_) folder_.clear();
        throw;
    }
    if (options_.step_done) options_.step_done();
}

void tile_search::forget_tiles() {
    survey_ = {};
    bounds_known_ = false;
    cells_.reset();
    faces_.clear();
    firsts_.clear();
}

bool tile_search::give_tiles(bool in_turn) {
    forget_tiles();
    const io::source in = io::source::open(input_, io::scratch_place::file);
    const auto make_store = [&](std::size_t points) -> std::unique_ptr<io::point_store> {
        if (all_.is_alone()) return place_for(points, in, folder_, memory_ / 4);
        return std::make_unique<shared_points>(folder_, all_, points, memory_ / 4);
    };
    std::optional<io::record_index> text;
    if (!all_.is_alone())
        text = survey_records({input_}, {.format = options_.format}, all_).front();
    const io::record_index* const known = text ? &*text : nullptr;
    io::face_rows rows =
        open_faces(in, input_, options_.format, make_store, {all_.rank(), all_.size()}, known);
    share_head(rows);
    in_turn = share_rows(rows, in_turn, known);
    others_read_ = !all_.is_alone();
    vertices_ = options_.vertices.value_or(rows.head.indexed ? vertex_identity::by_index
                                                             : vertex_identity::by_coordinates);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (rows.stored_faces > most || (vertices_ == vertex_identity::by_index && rows.points > most))
        throw std::length_error(
            "treeform::self_intersections_of_file: more than 2^32 - 1 faces or points");
    survey_.points = rows.points;
    survey_.bounds = rows.bounds;
    bounds_known_ = rows.bounds.has_value();
    survey_.stored_faces = rows.stored_faces;
    cells_.emplace(std::move(rows.sample), tile_count(rows.stored_faces));
    std::optional<std::string> failure;
    try {
        if (rows.head.stored_as == precision::float32)
            give_all<float>(rows);
        else
            give_all<double>(rows);
    } catch (const io_error& error) {
        if (all_.is_alone() || is_of_tiles(error)) throw;
        failure = error.what();
    }
    if (rows.left_out) survey_.stored_faces -= rows.left_out();
    survey_.header = std::move(rows.head);
    const auto failed = share_counts(failure);
    others_read_ = false;
    shared_points::remove(folder_, all_.rank());
    if (failed && in_turn) throw io_error(*failed);
    return !failed;
}

/// Gives each rank its part of the rows of a PLY. Where these are only alike if the first one is
/// like the others, any error from then on may come from one that is not. Returns whether all have
/// been read in turn, so that none can come.
bool tile_search::share_rows(const io::face_rows& rows, bool in_turn,
                             const io::record_index* known) const {
    if (all_.is_alone() || !rows.go_to) return true;
    std::vector<io::row_place> parts;
    try {
        if (!in_turn) parts = rows.row_parts(all_.size());
    } catch (const io_error&) {  // of the first row: it is said in its turn
    }
    in_turn = all_.sum(parts.empty() ? 1 : 0) > 0;
    if (in_turn)
        parts = rows_in_turn(
            all_,
            {.path = input_, .format = options_.format, .use = io::row_use::read, .known = known},
            [&](const row_block&) { pace_.check(); });
    const std::size_t next = all_.rank() + 1;
    rows.go_to(parts[next - 1],
               next == all_.size() ? std::nullopt : std::optional(parts[next].row));
    return in_turn;
}

/// What all have found ahead of the faces. When all are here, all points are where they are looked
/// for.
void tile_search::share_head(io::face_rows& rows) const {
    state_writer mine;
    mine.number(rows.head.stored_as == precision::float64 ? 1 : 0);
    store_box(rows.bounds, mine);
    mine.number(rows.sample.size());
    for (const point3& p : rows.sample) mine.point(p);
    rows.sample.clear();
    for (state_reader& one : all_.exchange(mine)) {
        if (one.number() != 0) rows.head.stored_as = precision::float64;
        base::add_to_box(rows.bounds, load_box(one));
        for (std::uint64_t left = one.number(); left > 0; --left)
            rows.sample.push_back(one.point());
    }
}

/// Sums up what all have given to the tiles, and what is to be reported of all faces. Returns why
/// the first one that has failed did.
std::optional<std::string> tile_search::share_counts(const std::optional<std::string>& failure) {
    state_writer mine;
    mine.number(failure ? 1 : 0);
    mine.text(failure.value_or(""));
    store_search(survey_, mine);
    for (std::size_t t = 0; t < cells_->size(); ++t)
        store_count(failure ? record_count{} : faces_[t].front(), mine);
    faces_.assign(cells_->size(), {});
    std::uint64_t triangles = 0;
    std::uint64_t searched = 0;
    usable_mesh part;
    std::optional<std::string> first;
    for (state_reader& one : all_.exchange(mine)) {
        const bool failed = one.number() != 0;
        const std::string why = one.text();
        if (failed && !first) first = why;
        file_search_result given = load_search(one);
        firsts_.push_back(triangles);
        triangles += given.triangles;
        searched += given.searched;
        part.non_finite += given.part.non_finite;
        part.degenerate += given.part.degenerate;
        base::add_to_box(survey_.bounds, given.bounds);
        survey_.header.warnings = std::move(given.header.warnings);  // the last one has them all
        for (auto& tile : faces_) tile.push_back(load_count(one));
    }
    survey_.triangles = triangles;
    survey_.searched = searched;
    survey_.part.non_finite = part.non_finite;
    survey_.part.degenerate = part.degenerate;
    if (triangles > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error(
            "treeform::self_intersections_of_file: more than 2^32 - 1 triangles");
    return first;
}

/// Faces that no cut parts, for they are at one place or reach across all, must fit.
void tile_search::check_memory() const {
    std::uint64_t most = 0;
    for (const auto& tile : faces_) {
        std::uint64_t sum = 0;
        for (const record_count& c : tile) sum += c.records;
        most = std::max(most, sum);
    }
    const std::uint64_t needed = base_bytes + most * bytes_a_face;
    if (most * bytes_a_face <= memory_) return;
    throw io_error(io_error::kind::memory, folder_.path(),
                   "the memory limit is too little: " + std::to_string(most) +
                       " faces meet one tile; " + std::to_string((needed >> 20) + 1) +
                       "M would be enough",
                   needed);
}

template <class Real>
void tile_search::give_all(io::face_rows& rows) {
    using record = tile_face<Real>;
    const std::size_t held =
        std::min<std::uint64_t>(memory_ / 4 / cells_->size(), std::uint64_t{4} << 20);
    std::vector<record_writer<record>> tiles;
    tiles.reserve(cells_->size());
    for (std::size_t t = 0; t < cells_->size(); ++t)
        tiles.emplace_back(faces_file(t, all_.rank()), held);
    std::vector<io::placed_triangle> block;
    std::vector<std::uint32_t> searched;
    const std::uint64_t expected = survey_.stored_faces / all_.size() + 1;
    while (rows.append(block, triangles_a_block, rows.head.warnings)) {
        look_at(block, searched);
        for (const std::uint32_t i : searched) {
            const record face = record_of<Real>(block[i], survey_.triangles + i);
            cells_->each_that_meets(*bounding_box(block[i].at),
                                    [&](std::uint32_t cell) { tiles[cell].put(face); });
        }
        survey_.triangles += block.size();
        if (survey_.triangles > std::numeric_limits<std::uint32_t>::max())
            throw std::length_error(
                "treeform::self_intersections_of_file: more than 2^32 - 1 triangles");
        block.clear();
        pace_.show("scatter", static_cast<double>(survey_.triangles) /
                                  static_cast<double>(std::max(survey_.triangles, expected)));
    }
    for (record_writer<record>& tile : tiles) faces_.push_back({tile.finish()});
}

/// Counts what is to be reported of all faces, and lists those of the block that are searched.
void tile_search::look_at(const std::vector<io::placed_triangle>& block,
                          std::vector<std::uint32_t>& searched) {
    mesh m;
    for (const io::placed_triangle& t : block) {
        const auto first = static_cast<std::uint32_t>(m.points.size());
        m.points.insert(m.points.end(), t.at.begin(), t.at.end());
        m.faces.push_back({first, first + 1, first + 2});
    }
    if (!bounds_known_) base::add_to_box(survey_.bounds, bounding_box(m.points));
    const invalid_faces defects = find_invalid_faces(m);
    survey_.part.non_finite += defects.nonfinite_faces.size();
    survey_.part.degenerate += defects.degenerate_faces.size();
    searched = drop_unusable_faces(m);
    if (defects.nonfinite_faces.empty()) {
        searched.resize(block.size());
        std::iota(searched.begin(), searched.end(), 0U);
    }
    if (options_.box) {
        std::vector<std::uint32_t> in_box = faces_in_box(m, options_.box->min, options_.box->max);
        for (std::uint32_t& f : in_box) f = searched[f];
        searched = std::move(in_box);
    }
    survey_.searched += searched.size();
}

void tile_search::search(std::size_t tile, std::size_t part, std::size_t of) {
    if (tile >= tiles())
        throw std::out_of_range("treeform::shared_search: tile " + std::to_string(tile) + " of " +
                                std::to_string(tiles()));
    pace_.show("pairs", static_cast<double>(part) / static_cast<double>(of));
    if (load(tile, true)) return;
    if (survey_.header.stored_as == precision::float32)
        search_as<float>(tile);
    else
        search_as<double>(tile);
    if (options_.step_done) options_.step_done();
}

/// In the order of the file.
template <class Real>
std::vector<tile_face<Real>> tile_search::faces_of(std::size_t tile) const {
    std::vector<tile_face<Real>> faces;
    for (std::size_t r = 0; r < faces_[tile].size(); ++r) {
        const auto some = all_of<tile_face<Real>>(faces_file(tile, r), faces_[tile][r]);
        faces.insert(faces.end(), some.begin(), some.end());
        for (auto f = faces.end() - std::ssize(some); f != faces.end(); ++f)
            f->triangle += static_cast<std::uint32_t>(firsts_[r]);
    }
    return faces;
}

template <class Real>
void tile_search::search_as(std::size_t tile) {
    const auto faces = faces_of<Real>(tile);
    const mesh m = mesh_of(faces, vertices_);
    const auto watch = [this](double) {
        try {
            pace_.check();
        } catch (const cancelled&) {
            return false;
        }
        return true;
    };
    face_pair_result all = self_intersections(
        m, {.vertices = vertex_identity::by_index, .kinds = options_.kinds, .progress = watch});
    if (all.status == treeform::status::cancelled) throw cancelled{};
    survey_.found.tree_seconds += all.tree_seconds;  // of the tiles that this process searches
    survey_.found.pair_seconds += all.pair_seconds;
    const std::string pairs_name = work_folder::own_name(std::to_string(tile) + ".pairs");
    const std::string hits_name = work_folder::own_name(std::to_string(tile) + ".hits");
    record_writer<tile_pair> pairs(folder_.file(pairs_name), piece_bytes);
    std::vector<std::uint32_t> hit;
    all.counts = {};
    for (const face_pair& pair : all.pairs) {
        if (cells_->cell_of(lowest_common(m, pair)) != tile) continue;
        pairs.put({faces[pair.a].triangle, faces[pair.b].triangle,
                   static_cast<std::uint32_t>(pair.kind), 0});
        ++all.counts[static_cast<std::size_t>(pair.kind)];
        hit.insert(hit.end(), {pair.a, pair.b});
    }
    std::sort(hit.begin(), hit.end());
    hit.erase(std::unique(hit.begin(), hit.end()), hit.end());
    record_writer<tile_face<double>> hits(folder_.file(hits_name), piece_bytes);
    for (const std::uint32_t f : hit) {
        const tile_face<Real>& of_tile = faces[f];
        tile_face<double> face{.triangle = of_tile.triangle, .stored = of_tile.stored};
        std::copy(of_tile.corners.begin(), of_tile.corners.end(), face.corners.begin());
        std::copy(of_tile.at.begin(), of_tile.at.end(), face.at.begin());
        hits.put(face);
    }
    all.pairs = {};
    const tile_found found{pairs.finish(), hits.finish(), std::move(all)};
    folder_.rename(pairs_name, std::to_string(tile) + ".pairs");
    folder_.rename(hits_name, std::to_string(tile) + ".hits");
    store(tile, found);
}

/// Faces keep their order, so pairs that ascend do so with the new numbers.
file_search_result tile_search::finish() {
    file_search_result result = survey_;
    result.tiles = tiles();
    std::vector<tile_face<double>> faces;
    std::vector<std::size_t> missing;
    for (std::size_t t = 0; t < tiles(); ++t) {
        const auto found = load(t, true);
        if (!found) missing.push_back(t);
        if (!missing.empty()) continue;
        const auto hits = all_of<tile_face<double>>(file(t, ".hits"), found->faces);
        faces.insert(faces.end(), hits.begin(), hits.end());
        for (const tile_pair& p : all_of<tile_pair>(file(t, ".pairs"), found->pairs))
            result.found.pairs.push_back({p.a, p.b, static_cast<pair_kind>(p.kind)});
        add_counts(result.found, found->counted);
    }
    if (!missing.empty()) folder_.fail_unfinished(missing);
    const auto before = [](const auto& f, const auto& g) { return f.triangle < g.triangle; };
    const auto same = [](const auto& f, const auto& g) { return f.triangle == g.triangle; };
    std::sort(faces.begin(), faces.end(), before);
    faces.erase(std::unique(faces.begin(), faces.end(), same), faces.end());
    result.part.mesh = mesh_of(faces, vertices_);
    for (const tile_face<double>& f : faces) result.part.triangle_of_face.push_back(f.stored);
    std::sort(result.found.pairs.begin(), result.found.pairs.end());
    const auto number_of = [&](std::uint32_t triangle) {
        const tile_face<double> wanted{.triangle = triangle};
        const auto at = std::lower_bound(faces.begin(), faces.end(), wanted, before);
        return static_cast<std::uint32_t>(at - faces.begin());
    };
    for (face_pair& pair : result.found.pairs)
        pair = {number_of(pair.a), number_of(pair.b), pair.kind};
    return result;
}

}  // namespace treeform::detail::stream
