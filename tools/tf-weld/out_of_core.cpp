#include "tools/tf-weld/out_of_core.hpp"

#include "tools/common/console.hpp"
#include "tools/common/sha256.hpp"
#include "tools/tf-weld/in_memory.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/properties.hpp"
#include "tools/tf-weld/tile_steps.hpp"
#include "tools/tf-weld/words.hpp"
#include <libmesh/io/io_error.hpp>
#include <libmesh/io/point_stream.hpp>
#include <libtree/version.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

namespace fs = std::filesystem;

std::uint64_t memory_allowed(const common_options& o) {
    if (o.memory > 0) return o.memory;
    const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
}

/// Of an empty cloud: the program, its threads and what is read and written.
constexpr std::uint64_t base_memory = std::uint64_t{32} << 20;

/// What is left for points.
std::uint64_t memory_for_tiles(const common_options& o) {
    const std::uint64_t allowed = memory_allowed(o);
    return allowed - std::min(base_memory, allowed / 2);
}

/// What welding takes in memory for a point of `header`, measured: its place once, its properties
/// twice, in the input and in the result, and what finds its neighbors.
std::uint64_t bytes_in_memory(const tf::mesh_file& header) {
    std::uint64_t properties = 0;
    if (const tf::element* vertices = tf::find_element(header.attributes, "vertex"))
        for (const tf::column& c : vertices->columns)
            if (c.role == tf::column_role::data) properties += tf::size_of(c.type);
    return sizeof(tf::point3) + 2 * properties + 48;
}

/// Why only memory will do; empty where tiles will, too.
std::string what_needs_memory(const job& work, const weld_request& request,
                              const tf::mesh_file& header) {
    const weld_settings& s = request.settings;
    if (s.keep != tf::weld_keep::first) return "--keep " + keep_in_words(s);
    if (s.borders) return "--borders";
    if (s.keep_manifold) return "--keep-manifold";
    if (!conditions_of(header, s).empty()) return "--same";
    if (work.options.precision == "float" && header.stored_as != tf::precision::single_)
        return "--precision float";
    return {};
}

/// Removes what processes that were killed have left of standard input.
void remove_spooled(const fs::path& beside) {
    const std::string start = beside.filename().string() + "-";
    const fs::path folder = beside.has_parent_path() ? beside.parent_path() : fs::path(".");
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(start)) continue;
        const std::string process = name.substr(start.size());
        if (process.empty() || process.find_first_not_of("0123456789") != std::string::npos)
            continue;
        if (!fs::exists("/proc/" + process, ignored)) fs::remove(entry.path(), ignored);
    }
}

/// Standard input as a file, as it is read more than once; what is read from standard input then
/// comes from there, too.
class spooled_input {
  public:
    spooled_input(job& work, const fs::path& beside)
        : keeper_(work.keeper), path_(beside.string() + "-" + std::to_string(::getpid())) {
        remove_spooled(beside);
        keeper_.unfinished(path_);
        fs::remove(path_);
        std::vector<std::byte> bytes(std::size_t{1} << 20);
        while (true) {
            keeper_.check();
            const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) throw failure(bad_input, "read", "standard input cannot be read");
            append_to(path_, std::span(bytes).first(static_cast<std::size_t>(count)));
            if (count == 0) break;
        }
        const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0 || ::dup2(file, STDIN_FILENO) < 0)
            throw failure(bad_input, "read", path_.string() + ": cannot be read");
        ::close(file);
    }
    ~spooled_input() {
        std::error_code ignored;
        fs::remove(path_, ignored);
        keeper_.finished(path_);
    }
    spooled_input(const spooled_input&) = delete;
    spooled_input& operator=(const spooled_input&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    guard& keeper_;
    fs::path path_;
};

fs::path folder_for(const job& work, const weld_request& request, const tile_settings& tiles) {
    if (!tiles.folder.empty()) return tiles.folder;
    std::optional<fs::path> beside = mesh_output(work.options, work.path);
    for (const fs::path& other :
         {request.outputs.removed, request.outputs.map, work.options.report})
        if ((!beside || *beside == "-") && !other.empty()) beside = other;
    if (!beside || *beside == "-")
        beside = fs::temp_directory_path() /
                 (work.path == "-" ? fs::path("standard_input") : fs::path(work.path).filename());
    return beside->string() + ".tf-weld-tiles";
}

json identity_of(const job& work, const fs::path& input, const weld_request& request,
                 const tile_settings& tiles) {
    const auto changed = fs::last_write_time(input).time_since_epoch().count();
    return {{"version", tf::version_string()},
            {"input", fs::absolute(input).string()},
            {"size", fs::file_size(input)},
            {"changed", static_cast<std::int64_t>(changed)},
            {"format", work.options.format},
            {"rule", name_of(request.settings.rule)},
            {"tolerance", request.settings.tolerance.given},
            {"memory", work.options.memory},
            {"points_per_tile", tiles.points_per_tile}};
}

const char* const leftovers = "unfinished.json";

/// What a process that was killed in the last pass has not brought to an end.
void remove_leftovers(const work_folder& folder) {
    const auto stored = folder.load(leftovers);
    if (!stored) return;
    for (const json& left : stored->value("folders", json::array())) {
        const fs::path path = left.is_string() ? left.get<std::string>() : std::string();
        if (path.filename().string().starts_with(".unfinished-")) fs::remove_all(path);
    }
}

/// Rows of a block on their way to a file of points.
class points_out {
  public:
    points_out(const fs::path& path, const tf::mesh_file& header, std::uint64_t count,
               const tf::write_options& options)
        : writer_(path, header, count, options) {}

    void write(const tf::point_block& block, const std::vector<std::uint32_t>& rows) {
        if (rows.empty()) return;
        some_.points.clear();
        for (const std::uint32_t row : rows) some_.points.push_back(block.points[row]);
        some_.properties = tf::gather(block.properties, rows);
        writer_.write(some_);
    }
    void write(const tf::point_block& block) { writer_.write(block); }
    tf::write_result commit() { return writer_.commit(); }

  private:
    tf::point_writer writer_;
    tf::point_block some_{};
};

/// The last pass over the input: what is kept, and what else is asked for.
class giving_back {
  public:
    giving_back(job& work, const weld_request& request, const fs::path& input,
                const point_survey& survey, tile_steps& steps, tiles_welded& welded,
                const work_folder& folder)
        : work_(work),
          asked_(request.outputs),
          survey_(survey),
          steps_(steps),
          welded_(welded),
          reader_(input, work.options.format),
          head_(reader_.header()),
          outputs_(work) {
        head_.stored_as = survey.single ? tf::precision::single_ : tf::precision::double_;
        naming_outputs([&] { open_files(); });
        std::vector<fs::path> unfinished = outputs_.unfinished();
        if (map_ && !map_->folder().empty()) unfinished.push_back(map_->folder());
        json folders = json::array();
        for (const fs::path& path : unfinished) folders.push_back(fs::absolute(path).string());
        folder.store(leftovers, {{"folders", folders}});
        if (map_ || !asked_.label.empty()) {
            welded_.kept.number();
            drops_.emplace(steps.all_drops(welded));
        }
    }

    void run() {
        if (result_ || removed_ || map_) naming_outputs([&] { give_all(); });
    }

  private:
    template <class Body>
    void naming_outputs(Body&& body) {
        try {
            body();
        } catch (const tf::io_error& error) {
            throw failure(bad_output, "output", outputs_.said_of_paths(error.what()));
        }
    }

    void give_all() {
        const auto show = work_.progress("write");
        tf::point_block block;
        while (reader_.read(block, points_a_block)) {
            give(block);
            first_ += block.points.size();
            show(static_cast<double>(first_) / static_cast<double>(survey_.points));
            work_.keeper.check();
        }
        steps_.step_done();
        work_.out.end_progress();
        if (first_ != survey_.points)
            throw failure(bad_input, "changed",
                          work_.name + ": the file changed while it was read");
        finish();
    }

    void open_files() {
        const common_options& o = work_.options;
        const std::uint64_t dropped = welded_.kept.dropped();
        if (!asked_.map.empty()) {
            map_.emplace(asked_.map, o.force, work_.keeper);
            as_csv_ = map_is_csv(asked_.map);
            if (as_csv_) map_->write(map_heading);
        }
        if (!asked_.removed.empty() && !o.dry_run)
            removed_.emplace(outputs_.add(asked_.removed, o.force), removed_head(), dropped,
                             write_options_for(o, check_points_format(asked_.removed), o.ascii));
        path_ = o.dry_run ? std::nullopt : mesh_output(o, work_.path);
        if (!path_) return;
        const bool labelled = !asked_.label.empty();
        if (labelled) add_label_to_head();
        const auto [format, ascii] = format_of(work_, head_, *path_);
        result_.emplace(outputs_.add(*path_, o.force || o.in_place), head_,
                        labelled ? survey_.points : survey_.points - dropped,
                        write_options_for(o, format, ascii));
    }

    /// Of the header only the points and what they have.
    [[nodiscard]] tf::mesh_file removed_head() const {
        tf::mesh_file head;
        head.format = head_.format;
        head.stored_as = head_.stored_as;
        if (const tf::element* vertices = tf::find_element(head_.attributes, "vertex"))
            head.attributes.elements.push_back(*vertices);
        return head;
    }

    void add_label_to_head() {
        tf::element& vertices = tf::obtain_element(head_.attributes, "vertex", 0);
        if (tf::set_column(vertices, {.name = asked_.label, .type = tf::scalar_type::uint32}))
            work_.warn("replaced",
                       "property " + asked_.label + " was there before; its values are replaced");
    }

    void give(tf::point_block& block) {
        if (drops_) number(block.points.size());
        kept_.clear();
        gone_.clear();
        for (std::uint32_t row = 0; row < block.points.size(); ++row)
            (welded_.kept.keeps(first_ + row) ? kept_ : gone_).push_back(row);
        given_ += kept_.size();
        if (map_) write_map();
        if (removed_) removed_->write(block, gone_);
        if (!result_) return;
        if (asked_.label.empty()) {
            result_->write(block, kept_);
            return;
        }
        const std::vector<std::uint32_t> groups(groups_.begin(), groups_.end());
        block.properties.rows = groups.size();
        tf::set_column(block.properties, tf::make_column<std::uint32_t>(asked_.label, groups));
        result_->write(block);
    }

    /// The groups of the points of a block.
    void number(std::size_t count) {
        groups_.resize(count);
        for (std::size_t row = 0; row < count; ++row) {
            const std::uint64_t point = first_ + row;
            std::uint64_t leader = point;
            for (; !drops_->empty() && drops_->front().id == point; drops_->pop())
                leader = drops_->front().leader;
            groups_[row] = welded_.kept.number_of(welded_.border.leader_of(leader));
        }
    }

    void write_map() {
        std::string text;
        for (std::size_t row = 0; row < groups_.size(); ++row)
            put_map_row(text, first_ + row, groups_[row], as_csv_);
        map_->write(text);
    }

    void finish() {
        if (given_ != survey_.points - welded_.kept.dropped())
            throw std::logic_error("points in are not points kept and points removed");
        if (removed_)
            for (const auto& w : removed_->commit().warnings) work_.warn(w.code, w.text);
        if (result_) {
            const tf::write_result written = result_->commit();
            enter_output(work_, *path_, written,
                         asked_.label.empty() ? std::optional<std::uint64_t>(0) : std::nullopt);
            for (const auto& w : written.warnings) work_.warn(w.code, w.text);
        }
        if (map_) map_->commit();
        outputs_.commit();
    }

    job& work_;
    const weld_outputs& asked_;
    const point_survey& survey_;
    tile_steps& steps_;
    tiles_welded& welded_;
    tf::point_reader reader_;
    tf::mesh_file head_;
    pending_outputs outputs_;
    std::optional<fs::path> path_{};
    std::optional<output_file> map_{};
    bool as_csv_ = false;
    std::optional<points_out> removed_{};
    std::optional<points_out> result_{};
    std::optional<tile_steps::drops> drops_{};
    std::uint64_t first_ = 0;  ///< number of the block's first point
    std::uint64_t given_ = 0;
    std::vector<std::uint64_t> groups_{};
    std::vector<std::uint32_t> kept_{};
    std::vector<std::uint32_t> gone_{};
};

void enter_source(job& work, const point_survey& survey, const fs::path& input) {
    json source{{"input", work.path}};
    const std::string sum = work.options.detailed() ? sha256_of_file(input) : std::string();
    source["format"] = survey.format;
    source["sha256"] = sum.empty() ? json(nullptr) : json(sum);
    source["precision_in"] = survey.single ? "float" : "double";
    source["points"] = survey.points;
    source["faces"] = 0;
    source["first_point"] = 0;
    for (const char* key : {"format", "sha256", "precision_in"}) work.entry[key] = source[key];
    work.entry["sources"].push_back(std::move(source));
    for (const tf::io_warning& w : survey.warnings) work.warn(w.code, w.text);
}

exit_status weld_in_tiles(job& work, const weld_request& request, const tile_settings& tiles,
                          const fs::path& input, const tf::mesh_file& header) {
    enter_blank_report(work, request);
    check_outputs(work, request);
    check_formats(work, request, header);
    work_folder folder(folder_for(work, request, tiles));
    remove_leftovers(folder);
    const tile_task task{.input = input,
                         .rule = request.settings.rule,
                         .memory = memory_for_tiles(work.options),
                         .points_per_tile = tiles.points_per_tile,
                         .stop_at = tiles.stop_at,
                         .identity = identity_of(work, input, request, tiles)};
    tile_steps steps(work, folder, task);
    const point_survey& survey = [&]() -> const point_survey& {
        const job::timer timing = work.time("read");
        return steps.look();
    }();
    enter_source(work, survey, input);
    if (survey.points == 0) throw failure(bad_input, "no-points", work.name + ": no points");
    if (!request.outputs.label.empty() && survey.points > std::numeric_limits<std::uint32_t>::max())
        throw failure(bad_input, "label", work.name + ": too many points for --label");

    welding w;
    w.points = survey.points;
    w.non_finite = survey.non_finite;
    w.box = survey.box;
    w.tolerance = request.settings.tolerance.used(w.box ? tf::diagonal(*w.box) : 0.0);
    {
        const job::timer timing = work.time("read");
        steps.scatter(w.tolerance);
    }
    tiles_welded welded = [&] {
        const job::timer timing = work.time("weld");
        steps.weld_tiles();
        return steps.weld_borders();
    }();
    w.counted = {w.points - welded.kept.dropped(), welded.groups};
    w.result.largest_move = welded.largest_move;
    work.out.result(work.name + ": " + verdict(w, request));
    say_details(work, w);
    enter_report(work, w, request);
    work.entry["polygons"] = {{"in", 0}, {"out", 0}};
    warn_of_harm(work, w);

    const job::timer timing = work.time("write");
    try {
        giving_back(work, request, input, survey, steps, welded, folder).run();
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", error.what());
    }
    folder.remove();
    return request.outputs.check && w.removed() > 0 ? found : done;
}

/// A cloud that can be read by blocks; none for anything else.
std::optional<tf::point_reader> cloud_at(const job& work, const fs::path& path) {
    try {
        return tf::point_reader(path, work.options.format);
    } catch (const tf::io_error&) {
        return std::nullopt;  // reading all of it will say why
    }
}

/// What is not a file counts as nothing.
std::uint64_t size_of_inputs(const job& work) {
    std::uint64_t sum = 0;
    for (const std::string& name : work.options.inputs) {
        std::error_code error;
        const std::uint64_t size = fs::file_size(name, error);
        if (!error) sum += size;
    }
    return sum;
}

/// Clouds and meshes take at most about so many bytes in memory for each of their file.
constexpr std::uint64_t most_per_byte = 16;

/// Where memory is limited and this may need more: says so before, and why when it does.
exit_status weld_held(job& work, const weld_request& request, const std::string& what,
                      std::uint64_t size) {
    if (work.options.memory == 0 || size < work.options.memory / most_per_byte)
        return weld_in_memory(work, request);
    const auto not_enough = [&] {
        return failure(stopped, "memory",
                       work.name + ": " + what +
                           " in memory, not in tiles, and --memory is not "
                           "enough for that");
    };
    try {
        return weld_in_memory(work, request,
                              what + " in memory, not in tiles; --memory may not be enough");
    } catch (const std::bad_alloc&) {
        throw not_enough();
    } catch (const failure& error) {
        if (error.code() == "memory") throw not_enough();
        throw;
    }
}

exit_status weld_file(job& work, const weld_request& request, const tile_settings& tiles,
                      const fs::path& path) {
    const bool asked = tiles.points_per_tile > 0;
    const std::uint64_t allowed = memory_allowed(work.options);
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    if (error || (!asked && size < allowed / 64)) return weld_in_memory(work, request);
    tf::mesh_file header;
    std::uint64_t needed = 0;
    {
        const auto cloud = cloud_at(work, path);
        if (!cloud) return weld_held(work, request, "meshes are welded", size);
        header = cloud->header();
        needed = cloud->count().value_or(size / 16) * bytes_in_memory(header);
    }
    if (!asked && needed + base_memory <= allowed) return weld_in_memory(work, request);
    const std::string only = what_needs_memory(work, request, header);
    if (only.empty()) return weld_in_tiles(work, request, tiles, path, header);
    const std::string text =
        only + " needs the whole cloud in memory, about " + grouped(needed / 1000000 + 1) + " MB";
    if (asked) throw failure(bad_usage, "usage", text);
    return weld_in_memory(work, request, text + "; without it, less memory would do");
}

}  // namespace

exit_status weld_somewhere(job& work, const weld_request& request, const tile_settings& tiles) {
    if (work.options.joined && work.options.inputs.size() > 1)
        return weld_held(work, request, "inputs are joined", size_of_inputs(work));
    if (work.path != "-") return weld_file(work, request, tiles, work.path);
    if (work.options.memory == 0 && tiles.points_per_tile == 0)
        return weld_in_memory(work, request);
    const spooled_input spooled(work, folder_for(work, request, tiles));
    return weld_file(work, request, tiles, spooled.path());
}

}  // namespace tools
