#include "tools/tf-weld/out_of_core.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/usable_input.hpp"
#include "tools/tf-weld/in_memory.hpp"
#include "tools/tf-weld/in_tiles.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <new>
#include <optional>
#include <string>

namespace tools {
namespace {

namespace fs = std::filesystem;

bool has_lists(const tf::mesh_file& header) {
    const tf::element* const vertices = header.attributes.find("vertex");
    return vertices != nullptr && std::ranges::any_of(vertices->columns, [](const auto& column) {
               return column.list_length.has_value();
           });
}

/// Of a mesh: faces or other rows behind the points.
bool has_rows_behind(const tf::mesh_file& header) {
    return std::ranges::any_of(header.attributes.elements, [](const tf::element& e) {
        return e.name != "vertex" && e.rows > 0 && !e.columns.empty();
    });
}

/// Other formats are written whole.
bool is_of_blocks(const std::string& format, bool is_mesh) {
    if (is_mesh) return format == "ply" || format == "obj";
    return format != "off" && format != "stl" && format != "glb" && format != "3mf";
}

/// Why only memory will do; empty where tiles will, too.
std::string what_needs_memory(const job& work, const weld_request& request,
                              const tf::mesh_file& header) {
    const bool is_mesh = has_rows_behind(header);
    const tf::weld_options& o = request.settings.options;
    if (work.options.shows()) return work.options.html.empty() ? "--png" : "--html";
    if (work.options.drop_non_finite) return "--drop-non-finite";
    if (o.only_borders) return "--borders";
    if (o.keep_manifold) return "--keep-manifold";
    const bool chooses = o.keep != tf::weld_keep::first;
    if (chooses && has_lists(header)) return "--keep of points with lists";
    const auto path = mesh_output(work.options, work.path);
    if (!header.indexed && chooses) return "--keep of an STL";
    if (!header.indexed && !request.outputs.label.empty()) return "--label of an STL";
    if (!header.indexed && request.settings.tolerance.value > 0.0 && !o.chain)
        return "-t of an STL (first make a PLY by tf-weld without -t)";
    const std::string format = path ? form_of(work, header, *path).format : std::string();
    if (path && !is_of_blocks(format, is_mesh))
        return "the output format " + format + (is_mesh ? " of a mesh" : " of a cloud");
    if (is_mesh && work.options.precision == "float" &&
        (header.stored_as == tf::precision::float64 || o.keep == tf::weld_keep::mean))
        return "--precision float of a mesh in doubles";
    const bool looks_again = chooses || work.options.precision == "float";
    if (path && *path == "-" && looks_again) return "reading back what goes to standard output";
    if (format == "obj" && looks_again) return "reading back an OBJ";
    return {};
}

/// None for what is no cloud that can be read by blocks. \throws tf::io_error where it cannot be
/// read
std::optional<tf::mesh_file> header_of(const tf::cloud_inputs& inputs,
                                       const tf::communicator& ranks) {
    try {
        return inputs.outline(ranks);
    } catch (const tf::io_error& error) {
        if (error.why() != tf::io_error::kind::blocks) throw;
        return std::nullopt;  // reading all of it will say why
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

/// What is not a file counts as nothing.
std::uint64_t size_of(const tf::cloud_inputs& inputs) {
    std::uint64_t sum = 0;
    for (const fs::path& path : inputs.paths) {
        std::error_code error;
        const std::uint64_t size = fs::file_size(path, error);
        if (!error) sum += size;
    }
    return sum;
}

std::string in_megabytes(std::uint64_t bytes) { return grouped(bytes / 1000000 + 1) + " MB"; }

/// Meshes take at most about so many bytes in memory for each of their file.
constexpr std::uint64_t most_per_byte = 16;

/// Where memory is limited and this may need more: says so before, and why when it does.
exit_status weld_mesh(job& work, const weld_request& request, const tile_options& tiles,
                      std::uint64_t size, const std::string& words) {
    if (work.options.memory == 0 || size < work.options.memory / most_per_byte)
        return weld_in_memory(work, request, tiles.per_tile > 0 ? words : remark_on_folder(tiles));
    const auto not_enough = [&] {
        return failure(stopped, "memory",
                       work.name + ": " + words + "; --memory is not enough for a file of " +
                           in_megabytes(size));
    };
    if (size > work.options.memory) throw not_enough();
    try {
        return weld_in_memory(work, request, words + "; --memory may not be enough");
    } catch (const std::bad_alloc&) {
        throw not_enough();
    } catch (const failure& error) {
        if (error.code() == "memory") throw not_enough();
        throw;
    }
}

exit_status weld_files(job& work, const weld_request& request, const tile_options& tiles,
                       const tf::cloud_inputs& inputs) {
    const bool asked = tiles.is_asked();
    const std::uint64_t allowed =
        work.options.memory > 0 ? work.options.memory : tf::weld_stream_options::default_memory();
    const std::uint64_t size = size_of(inputs);
    const auto follow_first = [&] {  // goes on when it has found nothing wrong
        if (tiles.communicator.rank > 0) tiles.communicator.exchange({});
    };
    if (size == 0 || (!asked && size < allowed / 64)) {
        follow_first();
        return weld_in_memory(work, request, remark_on_folder(tiles));
    }
    std::optional<tf::mesh_file> header;
    {
        const job::timer timing = work.time("read");
        header = header_of(inputs, tiles.communicator);
    }
    follow_first();
    if (!header && tiles.has_others())
        throw failure(
            bad_input, "read",
            work.name +
                ": not a cloud, plain PLY or binary STL; other meshes can only be welded by one "
                "process, in memory");
    if (!header)
        return weld_mesh(
            work, request, tiles, size,
            "meshes other than plain PLY and binary STL are welded in memory, not in tiles");
    const std::uint64_t needed =
        (std::uint64_t{32} << 20) +
        tf::weld_stream_options::memory_to_weld(*header, header->attributes.find("vertex")->rows);
    if (!asked && needed <= allowed) return weld_in_memory(work, request, remark_on_folder(tiles));
    const std::string only = what_needs_memory(work, request, *header);
    if (only.empty())
        return work_in(work, folder_for(work, request, tiles), tiles,
                       [&] { return weld_in_tiles(work, request, tiles, inputs, *header); });
    const bool is_mesh = has_rows_behind(*header);
    if (is_mesh && !tiles.has_others())
        return weld_mesh(work, request, tiles, size, only + " needs the whole mesh in memory");
    throw failure(asked ? bad_usage : stopped, asked ? "usage" : "memory",
                  work.name + ": " + only + " needs the whole " + (is_mesh ? "mesh" : "cloud") +
                      " in memory, about " + in_megabytes(needed) +
                      "; without it, a smaller --memory is enough");
}

}  // namespace

exit_status weld_somewhere(job& work, const weld_request& request, const tile_options& tiles) {
    const common_options& o = work.options;
    tf::cloud_inputs inputs{.format = o.format, .columns = o.columns, .mixed = request.mixed};
    if (o.joined)
        inputs.names = o.inputs;
    else
        inputs.names = {work.path};
    inputs.paths.assign(inputs.names.begin(), inputs.names.end());
    const auto piped = std::ranges::find(inputs.paths, fs::path("-"));
    if (tiles.has_others() && std::ranges::any_of(inputs.paths, is_read_once))
        throw failure(bad_usage, "usage",
                      "several processes cannot share a pipe as input; expected files");
    if (piped == inputs.paths.end()) return weld_files(work, request, tiles, inputs);
    if (o.memory == 0 && tiles.per_tile == 0) return weld_in_memory(work, request);
    std::optional<spooled_input> spooled;
    {
        const job::timer timing = work.time("read");
        spooled.emplace(work, folder_for(work, request, tiles));
    }
    *piped = spooled->path();
    return weld_files(work, request, tiles, inputs);
}

}  // namespace tools
