#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <tools/c/made/structs.hpp>

namespace tf = treeform;

struct treeform_shared_weld {
    void* owner;
    std::optional<treeform::stream_weld> steps;
    treeform::weld_stream_outputs outputs;
    bool looked;
};

struct treeform_point_reader {
    void* owner;
    std::optional<treeform::point_reader> reader;
};

struct treeform_point_writer {
    void* owner;
    std::optional<treeform::point_writer> writer;
};

namespace {

tf::cloud_inputs inputs_of(const char* const* inputs, std::size_t count,
                           const treeform_weld_stream_options& o) {
    tf::cloud_inputs from;
    for (const std::string& one : glue::texts(inputs, count, "inputs"))
        from.paths.emplace_back(one);
    if (from.paths.empty()) throw std::invalid_argument("no inputs to weld");
    from.format = glue::text(o.format);
    from.columns = glue::columns_of(o.columns, o.column_count, "columns");
    from.mixed = o.mixed != 0;
    return from;
}

tf::weld_stream_outputs outputs_of(const treeform_weld_stream_options& o, const char* output) {
    tf::weld_stream_outputs to;
    const tf::write_options how = glue::read(o.write);
    to.welded = {&glue::need(output, "output"), how};
    if (o.removed) to.removed = {o.removed, how};
    to.label = glue::text(o.label);
    to.withhold = o.withhold != 0;
    if (o.map)
        to.map = [map = o.map, data = o.map_data](std::span<const std::uint64_t> numbers) {
            map(numbers.data(), numbers.size(), data);
        };
    return to;
}

tf::weld_stream_options options_of(const treeform_weld_stream_options& o) {
    tf::weld_stream_options how;
    how.tolerance = o.tolerance;
    how.relative = o.relative != 0;
    how.rule = glue::choice<tf::weld_rule>(o.rule, 2, "rule");
    how.same = glue::conditions(o.same, o.same_count, "same");
    how.keep = glue::choice<tf::weld_keep>(o.keep, 5, "keep");
    how.keep_by = glue::text(o.keep_by);
    how.order = glue::choice<tf::weld_order>(o.order, 3, "order");
    how.order_by = glue::text(o.order_by);
    how.keep_seams = o.keep_seams != 0;
    how.across = glue::texts(o.across, o.across_count, "across");
    how.keep_degenerate = o.keep_degenerate != 0;
    how.as_las = o.as_las != 0;
    how.memory = o.memory;
    how.folder = glue::text(o.folder);
    how.points_per_tile = o.points_per_tile;
    how.communicator = glue::communicator_of(o.communicator);
    how.progress = glue::step_progress(o);
    return how;
}

/// Once.
void look(treeform_shared_weld& weld) {
    if (!weld.looked) glue::check(weld.steps->take_survey());
    weld.looked = true;
}

}  // namespace

void treeform_weld_stream_options_init(treeform_weld_stream_options* options, size_t size) {
    glue::init(options, size, treeform_weld_stream_options{});
}

treeform_code treeform_weld_stream(const char* const* inputs, size_t count, const char* output,
                                   const treeform_weld_stream_options* options,
                                   treeform_weld_stream_result** result) {
    return glue::guard([&] {
        glue::start(result);
        const auto o = glue::chosen(options, treeform_weld_stream_options_init);
        const tf::cloud_inputs from = inputs_of(inputs, count, o);
        return glue::give(tf::weld_stream(from, outputs_of(o, output), options_of(o)), result);
    });
}

treeform_code treeform_shared_weld_create(const char* const* inputs, size_t count,
                                          const treeform_weld_stream_options* options,
                                          treeform_shared_weld** weld) {
    return glue::guard([&] {
        glue::start(weld);
        const auto o = glue::chosen(options, treeform_weld_stream_options_init);
        tf::weld_stream_options how = options_of(o);
        how.shared = true;
        auto made = glue::make<treeform_shared_weld>();
        made->value.outputs = outputs_of(o, "");
        made->value.steps.emplace(inputs_of(inputs, count, o), how);
        glue::give(std::move(made), weld);
    });
}

treeform_code treeform_shared_weld_scatter(treeform_shared_weld* weld, size_t* tiles) {
    return glue::guard([&] {
        (void)glue::need(tiles, "tiles");
        look(glue::need(weld, "weld"));
        glue::check(weld->steps->scatter());
        *tiles = weld->steps->survey().tiles;
    });
}

treeform_code treeform_shared_weld_tile(treeform_shared_weld* weld, size_t tile) {
    return glue::guard([&] { glue::check(glue::need(weld, "weld").steps->weld_tile(tile)); });
}

treeform_code treeform_shared_weld_finish(treeform_shared_weld* weld, const char* output,
                                          treeform_weld_stream_result** result) {
    return glue::guard([&] {
        glue::start(result);
        tf::stream_weld& steps = *glue::need(weld, "weld").steps;
        tf::weld_stream_outputs to = weld->outputs;
        to.welded->path = &glue::need(output, "output");
        steps.check_tiles();
        look(*weld);
        glue::check(steps.weld());
        glue::check(steps.write(to));
        return glue::give(tf::weld_stream_result{steps.survey(), steps.counts(), steps.written()},
                          result);
    });
}

treeform_code treeform_shared_weld_remove_folder(treeform_shared_weld* weld) {
    return glue::guard([&] { glue::need(weld, "weld").steps->remove_folder(); });
}

uint64_t treeform_default_memory(void) {
    std::uint64_t bytes = 0;
    const treeform_code code =
        glue::guard([&] { bytes = tf::weld_stream_options::default_memory(); });
    return code == TREEFORM_OK ? bytes : 0;
}

treeform_code treeform_memory_to_weld(const treeform_file* file, uint64_t points, uint64_t* bytes) {
    return glue::guard([&] {
        glue::need(bytes, "bytes") =
            tf::weld_stream_options::memory_to_weld(glue::need(file, "file").content, points);
    });
}

treeform_code treeform_memory_to_stream(const treeform_file* file, uint64_t points,
                                        uint64_t* bytes) {
    return glue::guard([&] {
        glue::need(bytes, "bytes") =
            tf::weld_stream_options::memory_to_stream(glue::need(file, "file").content, points);
    });
}

treeform_code treeform_point_reader_create(const char* path, const char* format,
                                           treeform_point_reader** reader) {
    return glue::guard([&] {
        glue::start(reader);
        auto made = glue::make<treeform_point_reader>();
        made->value.reader.emplace(&glue::need(path, "path"), glue::text(format));
        glue::give(std::move(made), reader);
    });
}

treeform_code treeform_point_reader_header(const treeform_point_reader* reader,
                                           treeform_file** header, uint64_t* count,
                                           int32_t* known) {
    return glue::guard([&] {
        glue::start(header);
        (void)glue::need(count, "count");
        (void)glue::need(known, "known");
        const tf::point_reader& from = *glue::need(reader, "reader").reader;
        *count = from.count().value_or(0);
        *known = from.count().has_value();
        glue::give(tf::mesh_file(from.header()), header);
    });
}

treeform_code treeform_point_reader_next(treeform_point_reader* reader, size_t most,
                                         treeform_file** block) {
    return glue::guard([&] {
        glue::start(block);
        tf::point_reader& from = *glue::need(reader, "reader").reader;
        if (most == 0) throw std::invalid_argument("most is 0: no points would be read");
        tf::point_block points;
        if (!from.read(points, most)) return;
        tf::mesh_file made;
        made.format = from.header().format;
        made.stored_as = from.header().stored_as;
        made.mesh.points = std::move(points.points);
        made.attributes.elements.push_back(std::move(points.properties));
        glue::give(std::move(made), block);
    });
}

treeform_code treeform_point_writer_create(const char* path, const treeform_file* header,
                                           uint64_t count, const treeform_write_options* options,
                                           treeform_point_writer** writer) {
    return glue::guard([&] {
        glue::start(writer);
        auto made = glue::make<treeform_point_writer>();
        made->value.writer.emplace(&glue::need(path, "path"), glue::need(header, "header").content,
                                   count, glue::read(options));
        glue::give(std::move(made), writer);
    });
}

treeform_code treeform_point_writer_write(treeform_point_writer* writer,
                                          const treeform_file* block) {
    return glue::guard([&] {
        tf::point_writer& to = *glue::need(writer, "writer").writer;
        const tf::mesh_file& from = glue::need(block, "block").content;
        tf::point_block points;
        points.points = from.mesh.points;
        if (const tf::element* const found = from.attributes.find("vertex"))
            points.properties = *found;
        points.properties.rows = points.points.size();
        to.write(points);
    });
}

treeform_code treeform_point_writer_commit(treeform_point_writer* writer,
                                           treeform_written** written) {
    return glue::guard([&] {
        if (written) *written = nullptr;
        glue::give_written(glue::need(writer, "writer").writer->commit(), written);
    });
}
