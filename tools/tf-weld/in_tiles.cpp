#include "tools/tf-weld/in_tiles.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/shared_digests.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/words.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// A step of the library's work, which says whether it was cancelled.
template <class Step>
void take(job& work, const char* timed, const Step& step) {
    const job::timer timing = work.time(timed);
    tf::status ended{};
    try {
        ended = step();
    } catch (const tf::io_error& error) {
        if (error.why() == tf::io_error::kind::file) throw;
        throw failure_of(work, error);
    }
    work.call_ended(ended == tf::status::cancelled);
}

tf::weld_stream_options library_options(job& work, const weld_request& request,
                                        const tile_options& tiles, const tf::mesh_file& header) {
    const distance& tolerance = request.settings.tolerance;
    const tf::weld_options& asked = request.settings.options;
    tf::weld_stream_options options;
    options.tolerance = tolerance.value;
    options.relative = tolerance.relative;
    options.chain = asked.chain;
    options.same = asked.same;
    options.keep = asked.keep;
    options.keep_by = asked.keep_by;
    options.order_by = asked.order_by;
    options.highest_first = asked.highest_first;
    options.keep_seams = asked.keep_seams;
    options.ignored_seams = asked.ignored_seams;
    options.keep_degenerate = asked.keep_degenerate;
    const auto path = mesh_output(work.options, work.path);
    const std::string& format = work.options.output_format;
    options.as_las =
        path ? form_of(work, header, *path).is_las() : format == "las" || format == "laz";
    options.las_scale = work.options.las_scale;
    options.las_offset = work.options.las_offset;
    options.memory = work.options.memory;
    options.folder = folder_for(work, request, tiles);
    options.points_per_tile = tiles.per_tile;
    options.shared = tiles.is_shared();
    options.communicator = tiles.communicator;
    options.progress = [&work](std::string_view step, double share) {
        return work.progress(step)(share);
    };
    options.step_done = tiles.step_done();
    return options;
}

void say_of_damaged(job& work, const tf::cloud_survey& survey, const tile_options& tiles) {
    for (const fs::path& file : survey.damaged)
        work.warn("damaged", file.string() + ": the files of this tile are damaged" +
                                 (tiles.finish || tiles.plan ? "" : "; it is welded again"));
}

void say_of_earlier_work(job& work, const tf::cloud_survey& survey, const fs::path& folder) {
    if (survey.started_anew)
        work.warn("started-anew", folder.string() +
                                      ": the tiles there are not of this input and these options; "
                                      "started again");
    if (survey.continued)
        work.out.info(work.name + ": continued in " + folder.string() + ", " +
                      grouped(survey.finished_tiles) + " of " +
                      counted(survey.tiles, "tile", "tiles") + " finished earlier");
}

void enter_sources(job& work, const tf::cloud_survey& survey, const tf::cloud_inputs& inputs,
                   const tile_options& tiles) {
    const job::timer timing = work.time("read");
    const std::vector<std::string> sums = digests_for_report(inputs.paths, tiles);
    const auto precision = [](bool single) { return single ? "float" : "double"; };
    std::uint64_t first_point = 0;
    for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
        const tf::mesh_file& from = survey.sources[i];
        const std::uint64_t points = from.attributes.find("vertex")->rows;
        json source{{"input", inputs.names[i]}};
        source["format"] = from.format;
        source["sha256"] = sums[i].empty() ? json(nullptr) : json(sums[i]);
        source["precision_in"] = precision(from.stored_as == tf::precision::float32);
        source["points"] = points;
        source["faces"] = survey.faces;
        source["first_point"] = first_point;
        first_point += points;
        work.entry["sources"].push_back(std::move(source));
    }
    const json& first = work.entry["sources"].front();
    for (const char* key : {"format", "sha256"})
        work.entry[key] = inputs.paths.size() == 1 ? first[key] : json(nullptr);
    work.entry["precision_in"] = precision(survey.fits_float32);
    for (const tf::io_warning& w : survey.warnings)
        work.warn(w.code, w.code == "data-dropped" ? w.text + " by --join" : w.text);
}

void say_plan(job& work, const tf::cloud_survey& survey, const fs::path& folder) {
    if (survey.disk_bytes == 0) return;
    const std::string needed = grouped(survey.disk_bytes / 1000000 + 1) + " MB";
    work.out.info(work.name + ": " + grouped(survey.points) + " points in " +
                  counted(survey.tiles, "tile", "tiles") + ", about " + needed +
                  " on the disk in " + folder.string());
    if (survey.disk_bytes_free.value_or(survey.disk_bytes) < survey.disk_bytes)
        work.warn("space",
                  folder.string() + ": only " + grouped(*survey.disk_bytes_free / 1000000) +
                      " MB free on the disk, " + needed + " needed; --work names another folder");
}

/// Files as asked for, each in a place of its own until all are whole.
class stream_files {
  public:
    stream_files(job& work, const weld_request& request, const tile_options& tiles,
                 const tf::mesh_file& header)
        : work_(work), request_(request), tiles_(tiles), asked_(request.outputs), outputs_(work) {
        const common_options& o = work.options;
        if (!asked_.map.empty()) add_map();
        if (!asked_.removed.empty() && !o.dry_run)
            to_.removed = {add(asked_.removed, o.force),
                           write_options_for(o, {check_points_format(asked_.removed), o.ascii})};
        path_ = o.dry_run ? std::nullopt : mesh_output(o, work.path);
        if (path_)
            to_.welded = {add(*path_, o.force || o.in_place),
                          write_options_for(o, form_of(work, header, *path_))};
        to_.label = asked_.label;
        to_.withhold = asked_.withhold;
        to_.unfinished = outputs_.unfinished();
    }

    void write(tf::shared_weld& weld) {
        try {
            take(work_, "write", [&] { return weld.write(to_); });
        } catch (const tf::io_error& error) {
            throw failure(bad_output, "output", outputs_.said_of_paths(error.what()));
        }
        if (leads()) enter(weld.result());
        const job::timer timing = work_.time("write");
        if (map_) map_->commit();
        outputs_.commit();
        if (!tiles_.finish) weld.remove_folder();
    }

  private:
    [[nodiscard]] bool leads() const { return tiles_.communicator.rank == 0; }

    /// Of several ranks, the root has the files.
    [[nodiscard]] fs::path add(const fs::path& path, bool force) {
        return leads() ? outputs_.add(path, force) : path;
    }

    void add_map() {
        to_.map_text = [as_csv = map_is_csv(asked_.map)](std::uint64_t first, auto numbers) {
            std::string text = as_csv && first == 0 ? map_heading : "";
            for (const std::uint64_t number : numbers) put_map_row(text, first++, number, as_csv);
            return text;
        };
        if (!written_directly(asked_.map)) {
            to_.map_path = add(asked_.map, work_.options.force);
            return;
        }
        if (leads()) map_.emplace(asked_.map, work_.options.force);
        to_.map = [this, next = std::uint64_t{0}](auto numbers) mutable {
            map_->write(to_.map_text(next, numbers));
            next += numbers.size();
        };
    }

    void enter(const tf::weld_stream_result& written) {
        if (written.label_replaced) warn_of_replaced(work_, asked_.label);
        if (written.removed) work_.warn(written.removed->warnings);
        warn_of_las_grid(work_, "means", written.las_moved);
        if (written.welded)
            enter_result(work_, request_, *path_, *written.welded, written.mergeable);
    }

    job& work_;
    const weld_request& request_;
    const tile_options& tiles_;
    const weld_outputs& asked_;
    pending_outputs outputs_;
    std::optional<fs::path> path_{};
    std::optional<output_file> map_{};
    tf::weld_stream_outputs to_{};
};

welding in_words_of_memory(const tf::weld_stream_result& result) {
    const tf::cloud_survey& survey = result.survey;
    welding w;
    w.points = survey.points;
    w.polygons = survey.faces;
    w.triangles = survey.triangles;
    w.box = survey.box;
    w.tolerance = survey.tolerance;
    w.conditions = survey.conditions;
    w.result.statistics = result.statistics;
    w.counted = {.points = result.kept, .triangles = result.triangles};
    return w;
}

tf::status weld_tile(job& work, tf::shared_weld& weld, const tile_options& options) {
    const std::uint64_t tile = *options.tile;
    const std::size_t tiles = weld.tiles();
    if (tile >= tiles)
        throw failure(bad_usage, "usage",
                      "--tile " + std::to_string(tile) + ": there are only " +
                          counted(tiles, "tile", "tiles"));
    const tf::status ended = weld.weld_tile(tile);
    say_of_damaged(work, weld.survey(), options);
    if (ended == tf::status::ok)
        work.out.result(work.name + ": tile " + std::to_string(tile) + " of " + grouped(tiles) +
                        " done");
    return ended;
}

}  // namespace

fs::path folder_for(const job& work, const weld_request& request, const tile_options& tiles) {
    return tiles.folder_for(work, "tf-weld",
                            {mesh_output(work.options, work.path).value_or(fs::path()),
                             request.outputs.removed, request.outputs.map, tiles.report});
}

exit_status weld_in_tiles(job& work, const weld_request& request, const tile_options& tiles,
                          const tf::cloud_inputs& inputs, const tf::mesh_file& header) {
    enter_blank_report(work, request);
    const bool leads = tiles.communicator.rank == 0;
    if (leads) check_outputs(work, {request.outputs.map}, {request.outputs.removed});
    check_formats(work, request, header);
    const tf::weld_stream_options options = library_options(work, request, tiles, header);
    std::optional<tf::shared_weld> weld;
    try {
        const tf::element* const faces = header.attributes.find("face");
        static_cast<void>(request.settings.options.conditions(header.attributes,
                                                              faces != nullptr && faces->rows > 0));
        if (tiles.communicator.size > 1 && leads) tiles.communicator.exchange({});
        take(work, "read", [&] {
            weld.emplace(inputs, options);
            if (tiles.tile) return weld_tile(work, *weld, tiles);
            if (tiles.finish) static_cast<void>(weld->tiles());
            return weld->take_survey();
        });
    } catch (const tf::weld_property_error& error) {
        throw property_failure(error, header.attributes);
    }
    if (tiles.tile) return done;
    const tf::cloud_survey& survey = weld->survey();
    say_of_damaged(work, survey, tiles);
    say_of_earlier_work(work, survey, options.folder);
    enter_sources(work, survey, inputs, tiles);
    if (survey.points == 0) throw failure(bad_input, "no-points", work.name + ": no points");
    if (!request.outputs.label.empty() && survey.points > std::numeric_limits<std::uint32_t>::max())
        throw failure(bad_input, "label", work.name + ": too many points for --label");
    say_plan(work, survey, options.folder);
    take(work, "read", [&] { return weld->scatter(); });
    enter_tiles(work, survey.tiles, options.folder, survey.unfinished);
    if (tiles.plan) {
        say_tiles(work);
        return done;
    }
    take(work, "weld", [&] { return weld->weld(); });
    work.entry["tiles"]["unfinished"] = json::array();

    const tf::weld_stream_result result = weld->result();
    const welding w = in_words_of_memory(result);
    work.out.result(work.name + ": " + verdict(w, request));
    say_details(work, w);
    enter_report(work, w, request);
    work.entry["polygons"] = {{"in", w.polygons},
                              {"out", request.outputs.drops_nothing() ? w.polygons : result.faces}};
    warn_of_defects(work, w);
    stream_files(work, request, tiles, header).write(*weld);
    return request.outputs.check && w.removed() > 0 ? found : done;
}

}  // namespace tools
