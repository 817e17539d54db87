/// \file
/// What is stored of a plan and of its tiles, and taken over by a later run.

#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <bit>
#include <utility>

namespace treeform::detail::stream {
namespace {

const char* const plan_name = "plan";
constexpr std::uint64_t bytes_of_sample = 512;  ///< of a point in both samples, and plans by them

longest_move load_move(state_reader& state) {
    const point3 from = state.point();
    longest_move m;
    m.consider(from, state.point());
    return m;
}

void store_cuts(const tile_cuts& cuts, state_writer& state) {
    state.number(cuts.nodes().size());
    for (const tile_cuts::node& n : cuts.nodes()) {
        state.numbers(n.direction, n.above);
        state.real(n.cut);
    }
}

tile_cuts load_cuts(state_reader& state, double tolerance) {
    std::vector<tile_cuts::node> nodes;
    for (std::uint64_t left = state.number(); left > 0 && state.whole(); --left)
        nodes.push_back({static_cast<std::uint32_t>(state.number()),
                         static_cast<std::uint32_t>(state.number()), state.real()});
    return {std::move(nodes), tolerance};
}

void store_grid(const las_header& header, state_writer& state) {
    for (const double x : header.scale) state.real(x);
    for (const double x : header.offset) state.real(x);
}

void load_grid(state_reader& state, joined_points& to) {
    las_header grid;
    for (double& x : grid.scale) x = state.real();
    for (double& x : grid.offset) x = state.real();
    if (to.lacks_las_grid()) to.set_las_grid(grid);
}

template <class Record>
bool is_there(const std::filesystem::path& path, const record_count& count, bool check) {
    return check ? is_whole<Record>(path, count) : size_of(path) == count.records * sizeof(Record);
}

std::string name_of_done(std::size_t t) { return std::to_string(t) + ".done"; }

}  // namespace

void tile_steps::take_survey() {
    if (task_.options.shared && has_tiles()) {
        survey_tiles();
        say_plan();
        return;
    }
    check_before_survey();
    if (!task_.options.shared && resume_tiles()) {
        unpack();
    } else {
        const bool anew = has_plan();
        const std::vector<std::filesystem::path> damaged = survey_.cloud.damaged;
        if (communicator_.is_root()) folder_.clear();
        tiles_.clear();
        unpack();
        if (source_.lacks_las_grid())
            source_.set_las_grid(las_grid_of(source_, communicator_, read_by(communicator_.rank()),
                                             pace_,
                                             {task_.options.las_scale, task_.options.las_offset}));
        const std::size_t most = std::bit_floor(
            std::clamp<std::uint64_t>(task_.options.memory / bytes_of_sample, 1U << 12, 1U << 18));
        survey_ = stream::survey(
            source_, communicator_, read_by(communicator_.rank()),
            task_.options.relative ? std::nullopt : std::optional(task_.options.tolerance), most,
            pace_);
        survey_.cloud.started_anew = anew;
        survey_.cloud.damaged = damaged;
        set_tolerance();
        if (communicator_.is_root()) plan();
        share_cuts();
    }
    say_plan();
}

void tile_steps::unpack() {
    if (!unpacked_) unpacked_.emplace(folder_, communicator_, task_.inputs, source_, pace_);
}

/// As rank 0 has planned.
void tile_steps::share_cuts() {
    state_writer mine;
    if (communicator_.is_root()) store_cuts(*cuts_, mine);
    std::vector<state_reader> received = communicator_.exchange(mine);
    if (!communicator_.is_root()) cuts_ = load_cuts(received.front(), tolerance_);
}

bool tile_steps::has_plan() const { return folder_.load(plan_name).has_value(); }

void tile_steps::store_plan() const {
    state_writer state;
    state.text(task_.identity);
    store(survey_, state);
    if (task_.options.as_las) store_grid(*source_.header().las, state);
    state.number(numbers_.size());
    for (const record_count& part : numbers_) store_count(part, state);
    store_cuts(*cuts_, state);
    state.numbers(needs_.tiles, needs_.borders, communicator_.size());
    for (const tile& t : tiles_) {
        for (const record_count& part : t.points) store_count(part, state);
        state.number(t.own);
    }
    folder_.store(plan_name, state);
}

bool tile_steps::load_plan() {
    auto state = folder_.load(plan_name);
    if (!state || state->text() != task_.identity) return false;
    survey_ = load_survey(*state);
    if (task_.options.as_las) load_grid(*state, source_);
    set_tolerance();
    numbers_.clear();
    for (std::uint64_t left = state->number(); left > 0 && state->whole(); --left)
        numbers_.push_back(load_count(*state));
    cuts_ = load_cuts(*state, tolerance_);
    needs_.tiles = state->number();
    needs_.borders = state->number();
    tiles_.assign(cuts_->size(), {});
    const std::uint64_t parts = state->number();
    for (tile& t : tiles_) {
        for (std::uint64_t r = 0; r < parts && state->whole(); ++r)
            t.points.push_back(load_count(*state));
        t.own = state->number();
    }
    say_plan();
    return state->whole();
}

/// What is there of a tile: the results, or else the points.
bool tile_steps::find_tile(std::size_t t, bool check) {
    if (load_tile(t, check)) return true;
    const std::vector<record_count>& parts = tiles_[t].points;
    for (std::size_t r = 0; r < parts.size(); ++r)
        if (size_of(points_file(t, r)) != parts[r].records * sizeof(std::uint64_t)) return false;
    return true;
}

bool tile_steps::find_plan() {
    scattered_ = load_plan();
    return scattered_;
}

void tile_steps::survey_tiles() {
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        if (!find_tile(t, false)) folder_.fail_with_other_tiles();
    survey_.cloud.continued = true;
    count_finished();
}

bool tile_steps::finds_tiles() {
    bool whole = load_plan();
    for (std::size_t t = 0; whole && t < tiles_.size(); ++t) whole = find_tile(t, false);
    if (whole) count_finished();
    return whole;
}

/// Of several ranks, each looks at some tiles.
bool tile_steps::resume_tiles() {
    bool whole = load_plan();
    const std::size_t all = whole ? tiles_.size() : 0;
    state_writer mine;
    for (std::size_t t = communicator_.rank(); t < all; t += communicator_.size())
        whole = find_tile(t, true) && whole;
    whole = has_numbers() && whole;
    mine.number(whole ? 1 : 0);
    for (std::size_t t = communicator_.rank(); t < all; t += communicator_.size())
        mine.number(tiles_[t].finished ? 1 : 0);
    mine.number(survey_.cloud.damaged.size());
    for (const std::filesystem::path& path : survey_.cloud.damaged) mine.text(path.string());
    std::vector<state_reader> received = communicator_.exchange(mine);
    for (state_reader& one : received) whole = one.number() != 0 && whole;
    survey_.cloud.damaged.clear();
    for (std::size_t t = 0; t < all; ++t) {
        const bool finished = received[t % received.size()].number() != 0;
        if (finished && t % received.size() != communicator_.rank())
            whole = load_tile(t, false) && whole;
    }
    for (state_reader& one : received)
        for (std::uint64_t left = one.number(); left > 0 && one.whole(); --left)
            survey_.cloud.damaged.push_back(one.text());
    scattered_ = survey_.cloud.continued = whole;
    count_finished();
    return whole;
}

void tile_steps::count_finished() {
    std::vector<std::size_t>& unfinished = survey_.cloud.unfinished;
    unfinished.clear();
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        if (!tiles_[t].finished) unfinished.push_back(t);
    survey_.cloud.finished_tiles = tiles_.size() - unfinished.size();
}

void tile_steps::store_tile(std::size_t t) const {
    const tile& mine = tiles_[t];
    state_writer state;
    for (const record_count& c : {mine.drops, mine.border, mine.asked, mine.members})
        store_count(c, state);
    state.point(mine.move.from());
    state.point(mine.move.to());
    folder_.store(name_of_done(t), state);
}

bool tile_steps::load_tile(std::size_t t, bool check) {
    auto state = folder_.load(name_of_done(t));
    if (!state) return false;
    tile& mine = tiles_[t];
    for (record_count* c : {&mine.drops, &mine.border, &mine.asked, &mine.members})
        *c = load_count(*state);
    mine.move = load_move(*state);
    mine.finished = state->whole() && is_there<tile_drop>(file(t, ".drops"), mine.drops, check) &&
                    is_there<std::uint64_t>(file(t, ".border"), mine.border, check) &&
                    is_there<std::uint64_t>(file(t, ".asked"), mine.asked, check) &&
                    is_there<tile_member>(file(t, ".members"), mine.members, check);
    if (!mine.finished) survey_.cloud.damaged.push_back(file(t, ".drops"));
    return mine.finished;
}

}  // namespace treeform::detail::stream
