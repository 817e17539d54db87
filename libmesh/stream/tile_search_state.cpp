/// \file
/// What is stored of a search in tiles, and taken over by a later run.

#include <libmesh/stream/tile_search.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tree/version.hpp>

#include <system_error>

namespace treeform::detail::stream {
namespace {

namespace fs = std::filesystem;

const char* const search_name = "search";

std::string name_of_found(std::size_t tile) { return std::to_string(tile) + ".found"; }

/// The numbers of a survey or of counters, in the order in which both are stored and loaded.
template <class Survey, class Visit>
void each_number(Survey& s, const Visit& visit) {
    for (auto* n : {&s.stored_faces, &s.triangles, &s.searched, &s.points, &s.part.non_finite,
                    &s.part.degenerate})
        visit(*n);
}

template <class Counters, class Visit>
void each_counter(Counters& c, const Visit& visit) {
    for (auto& n : c.counts) visit(n);
    for (auto* n : {&c.box_pairs, &c.exact_pairs, &c.predicates.calls, &c.predicates.undecided})
        visit(*n);
    for (auto& n : c.predicates.by_width) visit(n);
}

}  // namespace

void store_box(const std::optional<box3>& box, state_writer& state) {
    state.number(box ? 1 : 0);
    if (!box) return;
    state.point(box->min);
    state.point(box->max);
}

std::optional<box3> load_box(state_reader& state) {
    if (state.number() == 0) return std::nullopt;
    return box3{state.point(), state.point()};
}

void store_search(const file_search_result& s, state_writer& state) {
    each_number(s, [&](std::uint64_t n) { state.number(n); });
    store_box(s.bounds, state);
    state.text(s.header.format);
    state.numbers(s.header.stored_as, s.header.indexed);
    store_warnings(s.header.warnings, state);
}

file_search_result load_search(state_reader& state) {
    file_search_result s;
    each_number(s, [&](std::uint64_t& n) { n = state.number(); });
    s.bounds = load_box(state);
    s.header.format = state.text();
    s.header.stored_as = static_cast<precision>(state.number());
    s.header.indexed = state.number() != 0;
    s.header.warnings = load_warnings(state);
    return s;
}

std::string tile_search::identity() const {
    state_writer state;
    state.text(version_string());
    state.text(std::filesystem::absolute(input_).string());
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(input_, error);
    if (error) throw io_error(input_.string(), error);
    state.number(size);
    state.number(static_cast<std::uint64_t>(
        std::filesystem::last_write_time(input_).time_since_epoch().count()));
    const file_search_options& o = options_;
    state.text(o.format);
    state.number(o.vertices ? 1 + static_cast<std::uint64_t>(*o.vertices) : 0);
    for (std::size_t k = 0; k < pair_kind_count; ++k)
        state.number(o.kinds.contains(static_cast<pair_kind>(k)) ? 1 : 0);
    store_box(o.box, state);
    return state.bytes();
}

void tile_search::store_plan() const {
    state_writer state;
    state.text(identity());
    store_search(survey_, state);
    state.numbers(vertices_);
    cells_->store(state);
    state.number(firsts_.size());
    for (const std::uint64_t first : firsts_) state.number(first);
    for (const auto& tile : faces_)
        for (const record_count& part : tile) store_count(part, state);
    folder_.store(search_name, state);
}

bool tile_search::has_plan() const { return folder_.load(search_name).has_value(); }

bool tile_search::load_plan() {
    auto state = folder_.load(search_name);
    if (!state || state->text() != identity()) return false;
    file_search_result survey = load_search(*state);
    const auto vertices = static_cast<vertex_identity>(state->number());
    space_cells cells(*state);
    std::vector<std::uint64_t> firsts;
    for (std::uint64_t left = state->number(); left > 0 && state->whole(); --left)
        firsts.push_back(state->number());
    std::vector<std::vector<record_count>> faces(cells.size());
    for (auto& tile : faces)
        for (std::size_t r = 0; r < firsts.size(); ++r) tile.push_back(load_count(*state));
    if (!state->whole() || faces.empty()) return false;
    const std::uint64_t bytes = survey.header.stored_as == precision::float32
                                    ? sizeof(tile_face<float>)
                                    : sizeof(tile_face<double>);
    for (std::size_t t = 0; t < cells.size(); ++t) {
        if (load(t, false)) {
            ++survey.finished_tiles;
            continue;
        }
        for (std::size_t r = 0; r < firsts.size(); ++r)
            if (size_of(faces_file(t, r)) != faces[t][r].records * bytes) return false;
    }
    survey_ = std::move(survey);
    vertices_ = vertices;
    cells_ = std::move(cells);
    faces_ = std::move(faces);
    firsts_ = std::move(firsts);
    return true;
}

std::vector<std::size_t> tile_search::unfinished() const {
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < tiles(); ++t)
        if (!load(t, false)) found.push_back(t);
    return found;
}

void tile_search::store(std::size_t tile, const tile_found& found) const {
    state_writer state;
    store_count(found.pairs, state);
    store_count(found.faces, state);
    each_counter(found.counted, [&](std::uint64_t n) { state.number(n); });
    folder_.store(name_of_found(tile), state);
}

std::optional<tile_found> tile_search::load(std::size_t tile, bool check) const {
    auto state = folder_.load(name_of_found(tile));
    if (!state) return std::nullopt;
    tile_found found;
    found.pairs = load_count(*state);
    found.faces = load_count(*state);
    each_counter(found.counted, [&](std::uint64_t& n) { n = state->number(); });
    const fs::path pairs = file(tile, ".pairs");
    const fs::path hits = file(tile, ".hits");
    const bool whole = check ? is_whole<tile_pair>(pairs, found.pairs) &&
                                   is_whole<tile_face<double>>(hits, found.faces)
                             : size_of(pairs) == found.pairs.records * sizeof(tile_pair) &&
                                   size_of(hits) == found.faces.records * sizeof(tile_face<double>);
    if (!state->whole() || !whole) return std::nullopt;
    return found;
}

}  // namespace treeform::detail::stream
