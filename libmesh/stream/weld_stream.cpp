#include <libmesh/stream/tile_faces.hpp>
#include <libmesh/stream/tile_steps.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tree/version.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace treeform {
namespace {

namespace fs = std::filesystem;
using detail::stream::work_folder;

/// Changes whenever the files in the folder do.
constexpr std::uint64_t layout_of_folder = 6;

std::string identity_of(const cloud_inputs& inputs, const weld_stream_options& o) {
    detail::stream::state_writer state;
    state.text(version_string());
    state.number(layout_of_folder);
    for (const fs::path& input : inputs.paths) {
        state.text(fs::absolute(input).string());
        std::error_code error;
        const std::uint64_t size = fs::file_size(input, error);
        if (error) throw io_error(input.string(), error);
        state.number(size);
        state.number(
            static_cast<std::uint64_t>(fs::last_write_time(input).time_since_epoch().count()));
    }
    state.text(inputs.format);
    for (const auto& [name, source] : inputs.columns) {
        state.text(name);
        state.text(source);
    }
    state.numbers(inputs.mixed, o.chain);
    state.real(o.tolerance);
    for (const weld_condition& c : o.same) {
        state.text(c.property);
        state.real(c.tolerance);
    }
    state.text(o.order_by);
    state.numbers(o.highest_first, o.relative, o.as_las, o.keep_seams);
    for (const std::string& name : o.ignored_seams) state.text(name);
    for (const auto* grid : {&o.las_scale, &o.las_offset})
        for (const double x : grid->value_or(std::array<double, 3>{})) state.real(x);
    return state.bytes();
}

cloud_inputs named(cloud_inputs inputs) {
    if (inputs.paths.empty()) throw std::invalid_argument("treeform::weld_stream: no input");
    if (inputs.names.empty())
        for (const fs::path& path : inputs.paths) inputs.names.push_back(path.string());
    if (inputs.names.size() != inputs.paths.size())
        throw std::invalid_argument("treeform::weld_stream: expected one name for each input");
    return inputs;
}

detail::stream::tile_task task_of(cloud_inputs inputs, weld_stream_options options) {
    if (!(options.tolerance >= 0.0) || !std::isfinite(options.tolerance))
        throw std::invalid_argument(
            "treeform::weld_stream: the tolerance must be finite and not negative");
    inputs = named(std::move(inputs));
    options.shared = options.shared && options.communicator.size <= 1;
    if (options.memory == 0) options.memory = weld_stream_options::default_memory();
    const std::uint64_t memory = options.memory;
    options.memory = detail::stream::left_for_points(memory);
    if (options.folder.empty()) options.folder = inputs.paths.front().string() + ".tiles";
    std::string identity = identity_of(inputs, options);
    return {std::move(inputs), std::move(options), std::move(identity), memory};
}

/// In memory, equal corners of a soup are one before anything else is asked. Where that makes a
/// difference, tiles do not do it.
void check_soup(const mesh_file& header, const weld_stream_options& o) {
    if (header.indexed) return;
    if (o.keep != weld_keep::first || (o.tolerance > 0.0 && !o.chain))
        throw std::invalid_argument(
            "treeform::weld_stream: in tiles, an STL needs weld_keep::first, and no tolerance or "
            "the rule chain; a PLY supports all options");
}

/// Whether files with these headers have the same values of what conditions look at. Coordinates
/// are doubles in any file.
bool have_same_values(const mesh_file& a, const mesh_file& b,
                      const std::vector<weld_condition>& conditions) {
    const auto type_in = [](const mesh_file& header, const std::string& name) {
        const element* const vertices = header.attributes.find("vertex");
        const column* const found = vertices == nullptr ? nullptr : vertices->find(name);
        return found == nullptr || found->role != column_role::data ? std::nullopt
                                                                    : std::optional(found->type);
    };
    return std::ranges::all_of(conditions, [&](const weld_condition& c) {
        return type_in(a, c.property) == type_in(b, c.property);
    });
}

work_folder::use use_of(const weld_stream_options& o, const detail::stream::communicator& all) {
    if (o.shared) return work_folder::use::shared;
    if (!all.is_root()) all.barrier();  // the first one makes the folder
    return all.is_root() ? work_folder::use::alone : work_folder::use::member;
}

weld_stream_outputs welded_to(const fs::path& output) {
    weld_stream_outputs outputs;
    outputs.welded = {output, {}};
    return outputs;
}

}  // namespace

mesh_file cloud_inputs::outline(const treeform::communicator& ranks) const {
    const cloud_inputs all = named(*this);
    const detail::stream::joined_points points(all, false, detail::stream::communicator(ranks));
    mesh_file header = points.header();
    header.attributes.find_or_add("vertex", 0).rows = static_cast<std::size_t>(points.count());
    return header;
}

struct shared_weld::state {
    state(cloud_inputs inputs, weld_stream_options options)
        : task(task_of(std::move(inputs), std::move(options))),
          all(task.options.communicator),
          source(task.inputs, task.options.as_las, all),
          keys(source.header(), task.options),
          pace(task.options.progress),
          folder(task.options.folder, "weld", use_of(task.options, all)),
          steps(pace, folder, task, all, source, keys) {
        if (all.is_root()) all.barrier();
        all.barrier();  // or one would make again what the first one has removed
        source.wish_las_grid({task.options.las_scale, task.options.las_offset});
        if (!detail::stream::has_rows_behind(source.header())) return;
        check_soup(source.header(), task.options);
        faces.emplace(pace, folder, task, steps);
    }

    /// \throws io_error where there are none
    void check_tiles() {
        if (!steps.has_tiles()) folder.fail_without_tiles();
    }

    /// What a process has left that was killed is for one to remove that no other works beside.
    void hold_alone() {
        alone.emplace(folder, pace);
        detail::stream::remove_leftovers(folder);
    }

    /// Where the work is cancelled, says so.
    template <class Work>
    [[nodiscard]] treeform::status until_cancelled(const Work& work) {
        try {
            work();
        } catch (const detail::stream::cancelled&) {
            return made.status = status::cancelled;
        }
        return status::ok;
    }

    /// Of what was written, which is another cloud where points are not as they were.
    void count_mergeable(const weld_stream_outputs& outputs) {
        if (!outputs.welded || outputs.withhold || !outputs.label.empty()) return;
        made.mergeable = 0;
        const weld_stream_options& o = task.options;
        detail::stream::state_writer mine;
        mine.real(made.welded ? made.welded->max_displacement : 0.0);
        mine.text(outputs.welded->first.string());
        detail::stream::state_reader first = all.exchange(mine).front();
        const bool rounded = first.real() > 0.0;
        const fs::path path = first.text();
        if (o.keep == weld_keep::first && !rounded) return;
        weld_stream_options again = o;
        again.tolerance = steps.survey().tolerance;
        again.relative = false;
        again.keep = weld_keep::first;
        again.keep_by.clear();
        again.as_las = false;
        again.points_per_tile = 0;  // of the cloud
        again.folder += ".again";
        again.step_done = {};
        again.shared = false;
        again.same = keys.conditions();
        again.keep_seams = false;
        cloud_inputs input{.paths = {path}, .format = outputs.welded->second.format};
        const fs::path whole = folder.file("whole.ply");
        if (!again.same.empty() &&
            !have_same_values(source.header(), input.outline(o.communicator), again.same)) {
            weld_stream_outputs as_read{.unfinished = outputs.unfinished};
            as_read.welded = {whole,
                              {.precision = outputs.welded->second.precision, .keep_names = true}};
            weld_stream_result of_whole;
            detail::stream::write_outputs(pace, task, as_read, steps, *welded,
                                          rows ? &*rows : nullptr, nullptr, folder, of_whole);
            input = {.paths = {whole}};
        }
        // What has been enough so far is so for fewer points, be their rows somewhat longer.
        again.memory = task.memory + (std::uint64_t{8} << 20);
        shared_weld twice(input, again);
        twice.state_->faces.reset();
        const weld_stream_result result = run(twice, {});
        if (result.status == status::cancelled) throw detail::stream::cancelled{};
        made.mergeable = result.survey.points - result.kept;
        if (all.is_root()) fs::remove(whole);
    }

    [[nodiscard]] static weld_stream_result run(shared_weld& work,
                                                const weld_stream_outputs& outputs) {
        if (work.scatter() != status::ok) return work.result();
        weld_stream_result result = work.finish(outputs);
        if (result.status == status::ok) work.remove_folder();
        return result;
    }

    detail::stream::tile_task task;
    detail::stream::communicator all;
    detail::stream::joined_points source;
    detail::stream::point_keys keys;
    detail::stream::cancellable_progress pace;
    work_folder folder;
    std::optional<detail::stream::held_alone>
        alone{};  ///< a shared one, while tiles are made, and from `weld` on
    detail::stream::tile_steps steps;
    std::optional<detail::stream::tile_faces> faces{};  ///< of a mesh
    std::optional<detail::stream::tiles_welded> welded{};
    std::optional<detail::stream::kept_rows> rows{};
    bool surveyed = false;
    weld_stream_result made{};  ///< all fields except the survey
};

shared_weld::shared_weld(cloud_inputs inputs, weld_stream_options options)
    : state_(std::make_unique<state>(std::move(inputs), std::move(options))) {
    if (state_->all.is_root() && !state_->task.options.shared)
        detail::stream::remove_leftovers(state_->folder);
}
shared_weld::shared_weld(const fs::path& input, weld_stream_options options)
    : shared_weld(cloud_inputs{.paths = {input}}, std::move(options)) {}
shared_weld::~shared_weld() = default;
shared_weld::shared_weld(shared_weld&&) noexcept = default;
shared_weld& shared_weld::operator=(shared_weld&&) noexcept = default;

status shared_weld::take_survey() {
    state& s = *state_;
    return state_->until_cancelled([&] {
        if (s.task.options.shared && !s.steps.has_tiles()) {
            s.hold_alone();
            if (!s.steps.has_tiles() && s.steps.has_plan())  // else another process was quicker
                s.folder.fail_with_other_tiles();
        }
        s.steps.take_survey();
        if (s.faces) s.faces->take_survey(s.steps.survey());
        s.surveyed = true;
    });
}

const cloud_survey& shared_weld::survey() const { return state_->steps.survey(); }

status shared_weld::scatter() {
    status ended = state_->surveyed ? status::ok : take_survey();
    if (ended == status::ok) ended = state_->until_cancelled([&] { state_->steps.scatter(); });
    state_->alone.reset();
    return ended;
}

std::size_t shared_weld::tiles() {
    state_->check_tiles();
    return state_->steps.tiles();
}

std::vector<std::size_t> shared_weld::unfinished() {
    state_->check_tiles();
    return state_->steps.unfinished();
}

status shared_weld::weld_tile(std::size_t tile) {
    state_->check_tiles();
    return state_->until_cancelled([&] { state_->steps.weld_one(tile); });
}

status shared_weld::weld() {
    return state_->until_cancelled([&] {
        state& s = *state_;
        if (s.task.options.shared) {
            s.check_tiles();
            s.steps.check_finished();
            s.steps.check_before_borders();
            s.hold_alone();
            s.steps.unpack();
        } else {
            s.steps.weld_tiles();
        }
        s.welded.emplace(s.steps.weld_borders());
        if (s.task.options.keep != weld_keep::first)
            s.rows.emplace(s.pace, s.folder, s.all, s.task, s.steps, *s.welded);
        s.made.kept = survey().points - s.welded->dropped;
        s.made.statistics.groups = s.welded->groups;
        s.made.statistics.non_finite = survey().non_finite;
        s.made.statistics.max_displacement = s.welded->max_displacement;
        if (s.faces) s.faces->weld(*s.welded, s.rows ? &*s.rows : nullptr, s.made);
    });
}

status shared_weld::write(const weld_stream_outputs& outputs) {
    return state_->until_cancelled([&] {
        state& s = *state_;
        detail::stream::write_outputs(s.pace, s.task, outputs, s.steps, *s.welded,
                                      s.rows ? &*s.rows : nullptr, s.faces ? &*s.faces : nullptr,
                                      s.folder, s.made);
        s.count_mergeable(outputs);
    });
}

weld_stream_result shared_weld::finish(const weld_stream_outputs& outputs) {
    status ended = status::ok;
    if (!state_->surveyed) {
        state_->check_tiles();
        ended = take_survey();
    }
    if (ended == status::ok) ended = weld();
    if (ended == status::ok) static_cast<void>(write(outputs));
    return result();
}

weld_stream_result shared_weld::finish(const fs::path& output) { return finish(welded_to(output)); }

weld_stream_result shared_weld::result() const {
    weld_stream_result known = state_->made;
    known.survey = survey();
    return known;
}

void shared_weld::remove_folder() {
    state_->all.barrier();
    if (state_->all.is_root()) state_->folder.remove();
}

weld_stream_result weld_stream(const cloud_inputs& inputs, const weld_stream_outputs& outputs,
                               const weld_stream_options& options) {
    weld_stream_options alone = options;
    alone.shared = false;
    shared_weld work(inputs, std::move(alone));
    return shared_weld::state::run(work, outputs);
}

weld_stream_result weld_stream(const fs::path& input, const fs::path& output,
                               const weld_stream_options& options) {
    return weld_stream(cloud_inputs{.paths = {input}}, welded_to(output), options);
}

std::uint64_t weld_stream_options::default_memory() {
    const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
}

std::uint64_t weld_stream_options::memory_to_weld(const mesh_file& header, std::uint64_t points) {
    std::uint64_t properties = 0;
    if (const element* vertices = header.attributes.find("vertex"))
        for (const column& c : vertices->columns)
            if (c.role == column_role::data) properties += size_of(c.type);
    const std::uint64_t of_points = points * (sizeof(point3) + 2 * properties + 48);
    const element* const faces = header.attributes.find("face");
    if (faces == nullptr) return of_points;
    std::uint64_t of_face = 2 * sizeof(face) + 40;
    for (const column& c : faces->columns)
        if (c.role == column_role::data) of_face += 2 * size_of(c.type);
    return of_points + faces->rows * of_face;
}

std::uint64_t weld_stream_options::memory_to_stream(const mesh_file& header, std::uint64_t points) {
    std::uint64_t row = sizeof(point3);
    if (const element* vertices = header.attributes.find("vertex"))
        for (const column& c : vertices->columns) row += size_of(c.type);
    constexpr std::uint64_t samples_and_buffers = std::uint64_t{6} << 20;
    const std::uint64_t blocks = 4 * row * detail::stream::points_a_block;
    const std::uint64_t bits = 3 * (points / 8);
    // Pieces of rows that are sorted are fewer than their number has bytes for.
    const auto pieces = static_cast<std::uint64_t>(
        8.0 * std::sqrt(32.0 * 4096.0 * static_cast<double>(points)) / 4.0);
    return detail::stream::base_memory + samples_and_buffers + blocks + bits + pieces;
}

}  // namespace treeform
