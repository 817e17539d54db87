#pragma once
/// \file
/// Clouds larger than memory in C.

#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

/// The handle of a weld in steps.
struct shared_weld {
    tf::shared_weld steps;
    tf::weld_stream_outputs outputs;
};

}  // namespace glue

struct treeform_shared_weld {
    void* owner;
    std::optional<glue::shared_weld> content;
};

struct treeform_point_reader {
    void* owner;
    std::optional<treeform::point_reader> content;
};

struct treeform_point_writer {
    void* owner;
    std::optional<treeform::point_writer> content;
};

namespace glue {

inline tf::cloud_inputs inputs_of(const char* const* inputs, std::size_t count,
                                  const treeform_weld_stream_options& o) {
    if (count == 0) throw std::invalid_argument("no inputs to weld");
    return {.paths = paths(inputs, count, "inputs"),
            .format = text(o.format),
            .columns = columns_of(o.columns, o.column_count, "columns"),
            .mixed = o.mixed != 0};
}

inline tf::weld_stream_outputs outputs_of(const treeform_weld_stream_options& o,
                                          const char* output) {
    tf::weld_stream_outputs to;
    const tf::write_options how = read(o.write);
    to.welded = {&need(output, "output"), how};
    if (o.removed) to.removed = {o.removed, how};
    to.label = text(o.label);
    to.withhold = o.withhold != 0;
    if (o.map)
        to.map = [map = o.map, data = o.map_data](std::span<const std::uint64_t> numbers) {
            map(numbers.data(), numbers.size(), data);
        };
    return to;
}

/// Welds the cloud in the files `inputs` [count] (PLY, PCD, LAS, LAZ, PTS, XYZ, CSV), or the mesh
/// in one file (PLY, binary STL), and writes `output`, completely or not at all: the same bytes as
/// by `treeform_weld_file`. If the process is killed, the folder stays, and the same call resumes
/// there.
inline tf::weld_stream_result weld_stream(const char* const* inputs, std::size_t count,
                                          const char* output,
                                          const treeform_weld_stream_options* options) {
    const auto o = chosen(options, treeform_weld_stream_options_init);
    return tf::weld_stream(inputs_of(inputs, count, o), outputs_of(o, output), read(o));
}

/// Begins a weld in steps. Until it is freed, the handle holds a shared lock on the folder. Fails
/// while another handle scatters or finishes. All processes must pass the same inputs and options.
/// Options of outputs are used by `finish`; `communicator` is not used.
inline shared_weld shared_weld_create(const char* const* inputs, std::size_t count,
                                      const treeform_weld_stream_options* options) {
    const auto o = chosen(options, treeform_weld_stream_options_init);
    return {tf::shared_weld(inputs_of(inputs, count, o), read(o)), outputs_of(o, "")};
}

/// Writes the points of each tile, unless already done. For that, it needs to be the only handle on
/// the folder: it waits two seconds for others to be freed, then fails. `result`, which may be
/// null, is the number of tiles.
inline void shared_weld_scatter(shared_weld& weld, std::size_t* result) {
    check(weld.steps.scatter());
    if (result) *result = weld.steps.tiles();
}

/// Number of tiles; an error if no process has completed `scatter`.
inline std::size_t shared_weld_tiles(shared_weld& weld) { return weld.steps.tiles(); }

/// Numbers of the tiles that are not finished.
inline std::vector<std::uint32_t> shared_weld_unfinished(shared_weld& weld) {
    return numbers_of(weld.steps.unfinished());
}

/// Welds a tile, unless it is finished.
inline void shared_weld_tile(shared_weld& weld, std::size_t tile) {
    check(weld.steps.weld_tile(tile));
}

/// Welds the points along the borders of tiles, and writes `output`, completely or not at all. All
/// tiles must be finished. From this call until it is freed, the handle must be the only one on the
/// folder; waits as `scatter` does. `result` may be null.
inline void shared_weld_finish(treeform_shared_weld* weld, const char* output,
                               treeform_weld_stream_result** result) {
    if (result) *result = nullptr;
    shared_weld& all = content(weld, "weld");
    tf::weld_stream_outputs to = all.outputs;
    to.welded->first = std::string(&need(output, "output"));
    tf::weld_stream_result made = all.steps.finish(to);
    check(made.status);
    if (result) (void)give(std::move(made), result);
}

/// Removes the folder of the tiles.
inline void shared_weld_remove_folder(shared_weld& weld) { weld.steps.remove_folder(); }

/// Approximate memory in bytes to weld `points` points, with the properties of the file, in memory.
inline std::uint64_t memory_to_weld(const tf::mesh_file& file, std::uint64_t points) {
    return tf::weld_stream_options::memory_to_weld(file, points);
}

/// The least memory in bytes with which `points` points can be welded in tiles.
inline std::uint64_t memory_to_stream(const tf::mesh_file& file, std::uint64_t points) {
    return tf::weld_stream_options::memory_to_stream(file, points);
}

/// Opens a point file and reads its header. `format` may be null.
inline tf::point_reader point_reader_create(const std::filesystem::path& path,
                                            std::string_view format) {
    return tf::point_reader(path, format);
}

/// The file without its points, and their number.
inline void point_reader_header(const tf::point_reader& reader, treeform_file** header,
                                std::uint64_t* count) {
    start(header);
    need(count, "count") = reader.count();
    (void)give(tf::mesh_file(reader.header()), header);
}

/// Reads the next points, at most `most`, with their properties, as a file without faces; null if
/// none are left.
inline std::optional<tf::mesh_file> point_reader_next(tf::point_reader& reader, std::size_t most) {
    if (most == 0) throw std::invalid_argument("most is 0, so no points would be read");
    tf::mesh_file block;
    tf::element& properties = block.attributes.find_or_add("vertex", 0);
    if (!reader.read(block.mesh.points, properties, most)) return std::nullopt;
    block.format = reader.header().format;
    block.stored_as = reader.header().stored_as;
    return block;
}

/// Begins to write a file of `count` points with the format and columns of `header`; columns may
/// have been added.
inline tf::point_writer point_writer_create(const std::filesystem::path& path,
                                            const tf::mesh_file& header, std::uint64_t count,
                                            const tf::write_options& options) {
    return tf::point_writer(path, header, count, options);
}

/// Writes the points of a block.
inline void point_writer_write(tf::point_writer& writer, const tf::mesh_file& block) {
    tf::element properties{.name = "vertex"};
    if (const tf::element* const found = block.attributes.find("vertex")) properties = *found;
    properties.rows = block.mesh.points.size();
    writer.write(block.mesh.points, properties);
}

/// Finishes the file; without this call, the file is removed. `written` may be null.
inline tf::write_result point_writer_commit(tf::point_writer& writer) { return writer.commit(); }

}  // namespace glue
