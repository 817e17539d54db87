// Made by tools/bindings of streams.h and the headers of C++: see its README.
#include <tools/c/made/structs.hpp>
#include <tools/c/streams.hpp>

namespace tf = treeform;

tf::weld_stream_options glue::read(const treeform_weld_stream_options* options) {
    return read(chosen(options, treeform_weld_stream_options_init));
}
tf::weld_stream_options glue::read(const treeform_weld_stream_options& o) {
    tf::weld_stream_options how;
    how.tolerance = o.tolerance;
    how.relative = o.relative != 0;
    how.chain = o.chain != 0;
    how.same = conditions(o.same, o.same_count, "same");

    how.keep = choice<tf::weld_keep>(o.keep, 5, "keep");
    how.keep_by = text(o.keep_by);
    how.order_by = text(o.order_by);
    how.highest_first = o.highest_first != 0;
    how.keep_seams = o.keep_seams != 0;
    how.across = texts(o.across, o.across_count, "across");

    how.keep_degenerate = o.keep_degenerate != 0;
    how.as_las = o.as_las != 0;
    how.memory = o.memory;
    how.folder = text(o.folder);
    how.points_per_tile = o.points_per_tile;
    how.communicator = communicator_of(o.communicator);
    how.progress = step_progress(o);

    return how;
}

void treeform_weld_stream_options_init(treeform_weld_stream_options* options, size_t size) {
    treeform_weld_stream_options to{};
    const tf::weld_stream_options from;
    to.tolerance = from.tolerance;
    to.relative = from.relative;
    to.chain = from.chain;
    to.keep = static_cast<treeform_weld_keep>(from.keep);
    to.highest_first = from.highest_first;
    to.keep_seams = from.keep_seams;
    to.keep_degenerate = from.keep_degenerate;
    to.as_las = from.as_las;
    to.memory = from.memory;
    to.points_per_tile = from.points_per_tile;
    glue::init(options, size, to);
}

void glue::fill(keeper&, const tf::weld_stream_result& from, treeform_weld_stream_result& to) {
    to.points = from.survey.points;
    to.tolerance = from.survey.tolerance;
    to.tiles = from.survey.tiles;
    to.finished_tiles = from.survey.finished_tiles;
    to.kept = from.kept;
    to.faces = from.faces;
    to.triangles = from.triangles;
    to.groups = from.statistics.groups;
    to.non_finite = from.statistics.non_finite;
    to.collapsed = from.statistics.collapsed;
    to.degenerate = from.statistics.degenerate;
    to.max_displacement = from.statistics.max_displacement + from.survey.las_moved;
    to.nonmanifold_before = from.statistics.nonmanifold_before;
    to.nonmanifold_after = from.statistics.nonmanifold_after;
    to.flipped = from.statistics.flipped;
    to.format = from.welded ? from.welded->format.c_str() : "";
    to.mergeable = from.mergeable.value_or(0);
    to.mergeable_known = from.mergeable.has_value();
}

treeform_code treeform_weld_stream(const char* const* inputs, size_t count, const char* output,
                                   const treeform_weld_stream_options* options,
                                   treeform_weld_stream_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::weld_stream(inputs, count, output, options), result);
    });
}

treeform_code treeform_shared_weld_create(const char* const* inputs, size_t count,
                                          const treeform_weld_stream_options* options,
                                          treeform_shared_weld** weld) {
    return glue::guard([&] {
        glue::start(weld);
        return glue::give(glue::shared_weld_create(inputs, count, options), weld);
    });
}

treeform_code treeform_shared_weld_scatter(treeform_shared_weld* weld, size_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::shared_weld_scatter(glue::content(weld, "weld"));
    });
}

treeform_code treeform_shared_weld_tile(treeform_shared_weld* weld, size_t tile) {
    return glue::guard([&] { glue::shared_weld_tile(glue::content(weld, "weld"), tile); });
}

treeform_code treeform_shared_weld_finish(treeform_shared_weld* weld, const char* output,
                                          treeform_weld_stream_result** result) {
    return glue::guard([&] {
        glue::start(result);
        return glue::give(glue::shared_weld_finish(glue::content(weld, "weld"),
                                                   std::string(&glue::need(output, "output"))),
                          result);
    });
}

treeform_code treeform_shared_weld_remove_folder(treeform_shared_weld* weld) {
    return glue::guard([&] { glue::shared_weld_remove_folder(glue::content(weld, "weld")); });
}

treeform_code treeform_memory_to_weld(const treeform_file* file, uint64_t points,
                                      uint64_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::memory_to_weld(glue::content(file, "file"), points);
    });
}

treeform_code treeform_memory_to_stream(const treeform_file* file, uint64_t points,
                                        uint64_t* result) {
    return glue::guard([&] {
        (void)glue::need(result, "result");
        *result = glue::memory_to_stream(glue::content(file, "file"), points);
    });
}

treeform_code treeform_point_reader_create(const char* path, const char* format,
                                           treeform_point_reader** reader) {
    return glue::guard([&] {
        glue::start(reader);
        return glue::give(
            glue::point_reader_create(std::string(&glue::need(path, "path")), glue::text(format)),
            reader);
    });
}

treeform_code treeform_point_reader_header(const treeform_point_reader* reader,
                                           treeform_file** header, uint64_t* count) {
    return glue::guard(
        [&] { glue::point_reader_header(glue::content(reader, "reader"), header, count); });
}

treeform_code treeform_point_reader_next(treeform_point_reader* reader, size_t most,
                                         treeform_file** file) {
    return glue::guard([&] {
        glue::start(file);
        return glue::give(glue::point_reader_next(glue::content(reader, "reader"), most), file);
    });
}

treeform_code treeform_point_writer_create(const char* path, const treeform_file* header,
                                           uint64_t count, const treeform_write_options* options,
                                           treeform_point_writer** writer) {
    return glue::guard([&] {
        glue::start(writer);
        return glue::give(
            glue::point_writer_create(std::string(&glue::need(path, "path")),
                                      glue::content(header, "header"), count, glue::read(options)),
            writer);
    });
}

treeform_code treeform_point_writer_write(treeform_point_writer* writer,
                                          const treeform_file* block) {
    return glue::guard([&] {
        glue::point_writer_write(glue::content(writer, "writer"), glue::content(block, "block"));
    });
}

treeform_code treeform_point_writer_commit(treeform_point_writer* writer,
                                           treeform_written** written) {
    return glue::guard([&] {
        glue::give_written(
            [&] { return glue::point_writer_commit(glue::content(writer, "writer")); }, written);
    });
}
