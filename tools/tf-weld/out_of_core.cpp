#include "tools/tf-weld/out_of_core.hpp"

#include "tools/common/console.hpp"
#include "tools/common/sha256.hpp"
#include "tools/tf-weld/in_memory.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/properties.hpp"
#include "tools/tf-weld/spooled_input.hpp"
#include "tools/tf-weld/tile_outputs.hpp"
#include "tools/tf-weld/tile_steps.hpp"
#include "tools/tf-weld/words.hpp"
#include <treeform/mesh/io_error.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <optional>
#include <string>

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
    if (work.options.precision == "float" && header.stored_as != tf::precision::float32)
        return "--precision float";
    return {};
}

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
    give_back(work, request, input, survey, steps, welded, folder);
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
