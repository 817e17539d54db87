#include "tools/tf-weld/out_of_core.hpp"

#include "tools/common/console.hpp"
#include "tools/common/mesh_output.hpp"
#include "tools/tf-weld/in_memory.hpp"
#include "tools/tf-weld/in_tiles.hpp"
#include "tools/tf-weld/spooled_input.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <new>
#include <optional>
#include <string>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Why only memory will do; empty where tiles will, too.
std::string what_needs_memory(const job& work, const weld_request& request,
                              const tf::mesh_file& header) {
    const tf::weld_options& o = request.settings.options;
    if (o.keep != tf::weld_keep::first) return "--keep " + keep_in_words(o);
    if (request.outputs.withhold) return "--withhold";
    if (o.order != tf::weld_order::given) return "--order " + order_in_words(o);
    if (o.only_borders) return "--borders";
    if (o.keep_manifold) return "--keep-manifold";
    try {
        if (!tf::weld_conditions(header.attributes, false, o).empty()) return "--same";
    } catch (const tf::weld_property_error& error) {
        throw property_failure(error, header.attributes);
    }
    if (work.options.precision == "float" && header.stored_as != tf::precision::float32)
        return "--precision float";
    const auto path = mesh_output(work.options, work.path);
    const fs::path& removed = request.outputs.removed;
    if (!header.las && ((path && form_of(work, header, *path).is_las()) ||
                        written_form{extension_of(removed)}.is_las()))
        return "LAS of what is in another format";
    return {};
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
    const std::uint64_t allowed =
        work.options.memory > 0 ? work.options.memory : tf::default_memory();
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    if (error || (!asked && size < allowed / 64)) return weld_in_memory(work, request);
    tf::mesh_file header;
    std::uint64_t needed = 0;
    {
        const auto cloud = cloud_at(work, path);
        if (!cloud) return weld_held(work, request, "meshes are welded", size);
        header = cloud->header();
        needed = tf::memory_to_weld(header, cloud->count().value_or(size / 16));
    }
    constexpr std::uint64_t of_empty_cloud = std::uint64_t{32} << 20;
    if (!asked && needed + of_empty_cloud <= allowed) return weld_in_memory(work, request);
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
