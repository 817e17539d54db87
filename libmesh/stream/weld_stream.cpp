#include <libmesh/stream/tile_outputs.hpp>
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

std::string identity_of(const fs::path& input, const weld_stream_options& o) {
    detail::stream::state_writer state;
    state.text(version_string());
    state.text(fs::absolute(input).string());
    std::error_code error;
    const std::uint64_t size = fs::file_size(input, error);
    if (error) throw io_error(input.string() + ": cannot be read: " + error.message());
    state.number(size);
    state.number(static_cast<std::uint64_t>(fs::last_write_time(input).time_since_epoch().count()));
    state.text(o.format);
    state.number(static_cast<std::uint64_t>(o.rule));
    state.real(o.tolerance);
    state.number(o.relative ? 1 : 0);
    state.number(o.memory);
    state.number(o.points_per_tile);
    return state.bytes();
}

/// Of an empty cloud: the program, its threads and what is read and written.
constexpr std::uint64_t base_memory = std::uint64_t{32} << 20;

detail::stream::tile_task task_of(fs::path input, weld_stream_options options) {
    if (!(options.tolerance >= 0.0) || !std::isfinite(options.tolerance))
        throw std::invalid_argument(
            "treeform::weld_stream: the tolerance must be finite and not negative");
    if (options.memory == 0) options.memory = default_memory();
    options.memory -= std::min(base_memory, options.memory / 2);
    if (options.folder.empty()) options.folder = input.string() + ".tiles";
    std::string identity = identity_of(input, options);
    return {std::move(input), std::move(options), std::move(identity)};
}

}  // namespace

weld_stream_error::weld_stream_error(reason why, fs::path path, const std::string& text)
    : std::runtime_error(text), why_(why), path_(std::move(path)) {}

struct stream_weld::state {
    state(fs::path input, weld_stream_options options)
        : task(task_of(std::move(input), std::move(options))),
          pace(task.options.progress),
          folder(task.options.folder),
          steps(pace, folder, task) {}

    /// Where the work is cancelled, says so.
    template <class Work>
    [[nodiscard]] static treeform::status until_cancelled(const Work& work) {
        try {
            work();
        } catch (const detail::stream::cancelled&) {
            return status::cancelled;
        }
        return status::ok;
    }

    detail::stream::tile_task task;
    detail::stream::pacer pace;
    detail::stream::work_folder folder;
    detail::stream::tile_steps steps;
    std::optional<detail::stream::tiles_welded> welded{};
    weld_stream_counts counts{};
    weld_stream_written written{};
};

stream_weld::stream_weld(fs::path input, weld_stream_options options)
    : state_(std::make_unique<state>(std::move(input), std::move(options))) {
    detail::stream::remove_leftovers(state_->folder);
}
stream_weld::~stream_weld() = default;
stream_weld::stream_weld(stream_weld&&) noexcept = default;
stream_weld& stream_weld::operator=(stream_weld&&) noexcept = default;

status stream_weld::look() {
    return state::until_cancelled([&] { state_->steps.look(); });
}

const cloud_survey& stream_weld::survey() const { return state_->steps.survey(); }

status stream_weld::scatter() {
    return state::until_cancelled([&] { state_->steps.scatter(); });
}

status stream_weld::weld() {
    return state::until_cancelled([&] {
        state& s = *state_;
        s.steps.weld_tiles();
        s.welded.emplace(s.steps.weld_borders());
        s.counts = {survey().points - s.welded->kept.dropped(), s.welded->groups,
                    s.welded->max_displacement};
    });
}

const weld_stream_counts& stream_weld::counts() const { return state_->counts; }

status stream_weld::write(const weld_stream_outputs& outputs) {
    return state::until_cancelled([&] {
        state& s = *state_;
        s.written =
            detail::stream::give_back(s.pace, s.task, outputs, s.steps, *s.welded, s.folder);
    });
}

const weld_stream_written& stream_weld::written() const { return state_->written; }

void stream_weld::remove_folder() { state_->folder.remove(); }

weld_stream_result weld_stream(const fs::path& input, const weld_stream_outputs& outputs,
                               const weld_stream_options& options) {
    stream_weld work(input, options);
    weld_stream_result result;
    result.status = work.look();
    if (result.status == status::ok) result.status = work.scatter();
    if (result.status == status::ok) result.status = work.weld();
    if (result.status == status::ok) result.status = work.write(outputs);
    if (result.status == status::ok) work.remove_folder();
    result.survey = work.survey();
    result.counts = work.counts();
    result.written = work.written();
    return result;
}

weld_stream_result weld_stream(const fs::path& input, const fs::path& output,
                               const weld_stream_options& options) {
    weld_stream_outputs outputs;
    outputs.welded = {output, {}};
    return weld_stream(input, outputs, options);
}

std::uint64_t default_memory() {
    const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
}

std::uint64_t memory_to_weld(const mesh_file& header, std::uint64_t points) {
    std::uint64_t properties = 0;
    if (const element* vertices = find_element(header.attributes, "vertex"))
        for (const column& c : vertices->columns)
            if (c.role == column_role::data) properties += size_of(c.type);
    return points * (sizeof(point3) + 2 * properties + 48);
}

}  // namespace treeform
