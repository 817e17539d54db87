#include "tools/tf-weld/outputs.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tools {
namespace {

json path_entry(const std::filesystem::path& path) {
    return path.empty() ? json(nullptr) : json(path.string());
}

tf::write_result write_file(pending_outputs& outputs, const std::filesystem::path& path, bool force,
                            const tf::mesh_file& file, const tf::write_options& options) {
    const std::filesystem::path& writable = outputs.add(path, force);
    try {
        return tf::write(writable, file, options);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", outputs.said_of_paths(error.what()));
    }
}

void warn_of_near_points(job& work, bool rounded, std::uint64_t again,
                         const weld_request& request) {
    if (again == 0) return;
    work.warn(rounded ? "precision" : "within-tolerance",
              counted(again, "kept point is", "kept points are") +
                  " within the tolerance of another one" +
                  (request.settings.options.keep == tf::weld_keep::first
                       ? ", because of rounding; --precision double, in a format that has it, "
                         "avoids this"
                       : "; only --keep first avoids this"));
}

void look_for_folds(job& work, const tf::mesh& welded) {
    const std::vector<tf::point3> rounded = tf::rounded(welded.points, tf::precision::float32);
    const auto defects = tf::find_rounding_defects(welded, rounded, work.progress("rounding"));
    work.call_ended();
    warn_of_folds(work, defects, tf::precision::float32);
}

std::array<char, 8> little_endian(std::uint64_t number) {
    std::array<char, 8> bytes;
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>(number >> (8 * i) & 255U);
    return bytes;
}

bool is_of_points(const std::string& format) {
    constexpr std::array known{"ply", "pcd", "las", "laz", "xyz", "csv"};
    return std::find(known.begin(), known.end(), format) != known.end();
}

}  // namespace

void check_formats(const job& work, const weld_request& request, const tf::mesh_file& file) {
    check_properties(work, file);
    const auto path = mesh_output(work.options, work.path);
    if (!path) return;
    const std::string format = form_of(work, file, *path).format;
    if ((work.options.las_scale || work.options.las_offset) && format != "las" && format != "laz")
        refuse(path->string() + ": --las-scale and --las-offset need the format las or laz");
    if (!request.outputs.label.empty() && !is_of_points(format))
        refuse(path->string() +
               ": --label needs a format with properties: ply, pcd, las, laz, xyz, csv");
    if (request.outputs.withhold && format != "las" && format != "laz")
        refuse(path->string() + ": --withhold needs the format las or laz");
}

const std::filesystem::path& pending_outputs::add(const std::filesystem::path& path, bool force) {
    places_.push_back(std::make_unique<output_place>(path, force));
    return places_.back()->writable();
}

std::vector<std::filesystem::path> pending_outputs::unfinished() const {
    std::vector<std::filesystem::path> folders;
    for (const auto& place : places_)
        if (!place->folder().empty()) folders.push_back(place->folder());
    return folders;
}

std::string pending_outputs::said_of_paths(std::string text) const {
    for (const auto& place : places_) text = place->said_of_path(std::move(text));
    return text;
}

void pending_outputs::commit() {
    for (const auto& place : places_) place->commit();
    places_.clear();
}

std::string check_points_format(const std::filesystem::path& path) {
    std::string format = extension_of(path);
    if (format == "txt" || format == "asc") format = "xyz";
    if (!is_of_points(format))
        refuse(path.string() + ": points can be written as ply, pcd, las, laz, xyz or csv");
    return format;
}

void enter_blank_report(job& work, const weld_request& request) {
    json& entry = work.entry;
    for (const char* key : {"format", "sha256", "precision_in"}) entry[key] = nullptr;
    entry["sources"] = json::array();
    entry["tiles"] = nullptr;
    entry["points"] = nullptr;
    entry["faces"] = nullptr;
    entry["polygons"] = nullptr;
    entry["box"] = nullptr;
    entry["skipped"] = {{"non_finite", nullptr}};
    entry["tolerance"] = {{"given", request.settings.tolerance.given}, {"used", nullptr}};
    entry["rule"] = rule_in_words(request.settings.options);
    entry["keep"] = keep_in_words(request.settings.options);
    entry["order"] = order_in_words(request.settings.options);
    entry["same"] = json::array();
    entry["displacement"] = {{"max", nullptr}};
    entry["nonmanifold_edges"] = {{"before", nullptr}, {"after", nullptr}};
    entry["kept_apart"] = nullptr;
    entry["output"] = nullptr;
    for (const char* key : {"map", "removed", "label", "withheld"}) entry[key] = nullptr;
}

void enter_report(job& work, const welding& w, const weld_request& request) {
    json& entry = work.entry;
    const tf::weld_statistics& r = w.result.statistics;
    const bool all_kept = request.outputs.drops_nothing();
    entry["points"] = {{"in", w.points},
                       {"out", all_kept ? w.points : w.distinct()},
                       {"removed", all_kept ? 0 : w.removed()},
                       {"distinct", w.distinct()},
                       {"groups", r.groups}};
    entry["faces"] = {{"in", w.triangles},
                      {"out", all_kept ? w.triangles : w.triangles_kept()},
                      {"collapsed", r.collapsed},
                      {"degenerate", r.degenerate},
                      {"flipped", r.flipped}};
    entry["box"] = w.box;
    entry["skipped"] = {{"non_finite", r.non_finite}};
    entry["tolerance"]["used"] = w.tolerance;
    for (const auto& c : w.conditions)
        entry["same"].push_back({{"property", c.property}, {"tolerance", c.tolerance}});
    entry["displacement"] = {{"max", r.max_displacement}};
    entry["nonmanifold_edges"] = {{"before", r.nonmanifold_before}, {"after", r.nonmanifold_after}};
    entry["kept_apart"] = or_null(request.settings.options.keep_manifold, r.kept_apart);
    entry["map"] = path_entry(request.outputs.map);
    entry["removed"] = work.options.dry_run ? json(nullptr) : path_entry(request.outputs.removed);
    if (!request.outputs.label.empty()) entry["label"] = request.outputs.label;
    entry["withheld"] = or_null(request.outputs.withhold, w.removed());
}

bool map_is_csv(const std::filesystem::path& path) {
    return path == "-" || extension_of(path) == "csv";
}

void put_map_row(std::string& text, std::uint64_t input, std::uint64_t output, bool as_csv) {
    if (!as_csv) {
        const auto bytes = little_endian(output);
        text.append(bytes.data(), bytes.size());
        return;
    }
    text += std::to_string(input);
    text += ',';
    text += std::to_string(output);
    text += '\n';
}

void write_map(output_file& file, const welding& w, bool as_csv) {
    std::string text = as_csv ? map_heading : "";
    const auto& group = w.result.groups.group_of_point;
    for (std::size_t p = 0; p < group.size(); ++p) {
        put_map_row(text, p, group[p], as_csv);
        file.write_full_pieces(text);
    }
    file.write(text);
}

void write_removed(job& work, pending_outputs& outputs, const tf::mesh_file& file, const welding& w,
                   const std::filesystem::path& path) {
    std::vector<std::uint32_t> rows;
    rows.reserve(w.removed());
    for (std::uint32_t p = 0; p < w.points; ++p)
        if (!w.keeps(p)) rows.push_back(p);
    tf::mesh_file gone;
    gone.format = file.format;
    gone.stored_as = file.stored_as;
    gone.las = file.las;
    gone.ranges = file.ranges;
    gone.mesh.points.reserve(rows.size());
    for (const std::uint32_t p : rows) gone.mesh.points.push_back(file.mesh.points[p]);
    if (const tf::element* vertices = file.attributes.find("vertex"))
        gone.attributes.elements.push_back(vertices->gathered(rows));
    const auto written = write_file(
        outputs, path, work.options.force, gone,
        write_options_for(work.options, {check_points_format(path), work.options.ascii}));
    work.warn(written.warnings);
}

void warn_of_replaced(job& work, const std::string& label) {
    work.warn("replaced",
              "the input already has the property " + label + "; its values are replaced");
}

void warn_of_las_grid(job& work, const std::string& what, double moved) {
    if (moved > 0.0)
        work.warn("las-grid",
                  what + " are rounded to the scale of the LAS file, by at most " + brief(moved));
}

void enter_result(job& work, const weld_request& request, const std::filesystem::path& path,
                  const tf::write_result& written, std::optional<std::uint64_t> again) {
    enter_output(work, path, written);
    work.entry["output"]["within_tolerance"] = again;
    warn_of_rounding(work, written.max_displacement);
    warn_of_near_points(work, written.max_displacement > 0.0, again.value_or(0), request);
}

void write_result(job& work, pending_outputs& outputs, const tf::mesh_file& welded,
                  const welding& w, const weld_request& request,
                  const std::filesystem::path& path) {
    const common_options& o = work.options;
    const tf::write_result written = write_file(outputs, path, o.force || o.in_place, welded,
                                                write_options_for(o, form_of(work, welded, path)));
    std::optional<std::uint64_t> again;
    if (!request.outputs.drops_nothing())
        again = mergeable(work, welded, w, request.settings, written.written_as);
    enter_result(work, request, path, written, again);
    if (written.max_displacement > 0.0 && w.result.statistics.non_finite == 0)
        look_for_folds(work, welded.mesh);
}

}  // namespace tools
