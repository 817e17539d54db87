/// \file
/// What is stored of a plan and of its tiles, and taken over by a later run.

#include <libmesh/stream/tile_steps.hpp>

#include <algorithm>
#include <bit>

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

std::string name_of_done(std::size_t t) { return std::to_string(t) + ".done"; }

}  // namespace

void tile_steps::look() {
    const auto points = source_.count();
    const std::uint64_t least = points ? memory_to_stream(source_.header(), *points) : 0;
    if (least > task_.memory) fail_for_memory(least);
    if (!take_over()) {
        const bool anew = folder_.load(plan_name).has_value();
        const std::vector<std::filesystem::path> damaged = survey_.cloud.damaged;
        folder_.clear();
        tiles_.clear();
        const std::size_t most = std::bit_floor(
            std::clamp<std::uint64_t>(task_.options.memory / bytes_of_sample, 1U << 12, 1U << 18));
        survey_ = stream::survey(
            source_, task_.options.relative ? std::nullopt : std::optional(task_.options.tolerance),
            most, pace_);
        survey_.cloud.started_anew = anew;
        survey_.cloud.damaged = damaged;
    }
    set_tolerance();
    survey_.cloud.conditions = keys_.conditions();
    if (tiles_.empty()) cuts_ = plan();
    say_plan();
}

void tile_steps::store_plan() const {
    state_writer state;
    state.text(task_.identity);
    store(survey_, state);
    store_count(numbers_, state);
    state.number(tiles_.size());
    for (const tile& t : tiles_) {
        store_count(t.points, state);
        state.number(t.own);
    }
    folder_.store(plan_name, state);
}

bool tile_steps::take_over() {
    auto state = folder_.load(plan_name);
    if (!state || state->text() != task_.identity) return false;
    survey_ = load_survey(*state);
    numbers_ = load_count(*state);
    for (std::uint64_t left = state->number(); left > 0 && state->whole(); --left) {
        const record_count points = load_count(*state);
        tiles_.push_back({.points = points, .own = state->number()});
    }
    if (!state->whole()) return false;
    cloud_survey& cloud = survey_.cloud;
    bool whole = !has_order() || is_whole<std::uint64_t>(folder_.file(numbers_name), numbers_);
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        take_over_tile(t);
        cloud.finished_tiles += tiles_[t].finished ? 1 : 0;
        whole = whole &&
                (tiles_[t].finished ||
                 size_of(file(t, ".points")) == tiles_[t].points.records * sizeof(std::uint64_t));
    }
    cloud.continued = whole;
    return whole;
}

void tile_steps::store_tile(std::size_t t) const {
    const tile& mine = tiles_[t];
    state_writer state;
    for (const record_count& c : {mine.drops, mine.border, mine.members}) store_count(c, state);
    state.point(mine.move.from());
    state.point(mine.move.to());
    folder_.store(name_of_done(t), state);
}

void tile_steps::take_over_tile(std::size_t t) {
    auto state = folder_.load(name_of_done(t));
    if (!state) return;
    tile& mine = tiles_[t];
    for (record_count* c : {&mine.drops, &mine.border, &mine.members}) *c = load_count(*state);
    mine.move = load_move(*state);
    mine.finished = state->whole() && is_whole<tile_drop>(file(t, ".drops"), mine.drops) &&
                    is_whole<std::uint64_t>(file(t, ".border"), mine.border) &&
                    is_whole<tile_member>(file(t, ".members"), mine.members);
    if (!mine.finished) survey_.cloud.damaged.push_back(file(t, ".drops"));
}

}  // namespace treeform::detail::stream
