#include "tools/shell/mesh_output.hpp"

#include "tools/bindings/linked_files.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace tools {
namespace {

bool is_text(const std::string& format) {
    return format.ends_with("ascii") || format.starts_with("obj") || format.starts_with("off") ||
           format.starts_with("xyz") || format.starts_with("csv");
}

/// What was certified is what is on the disk now. GLB has faces by part and color, 3MF by part.
void look_again(const std::filesystem::path& path, const std::string& format,
                const tf::mesh& surface) {
    std::error_code error;
    const bool scene = format == "glb" || format == "3mf";
    if (path == "-" || !std::filesystem::is_regular_file(path, error)) return;
    const tf::mesh_file written = tf::read(path, format);
    const bool numbered = !scene && written.indexed;
    if (!tf::same_triangles(written.mesh, surface, scene) ||
        (numbered && written.mesh.faces != surface.faces))
        throw std::logic_error("the file written does not hold what was certified");
}

/// `check` looks at what was written before it has its name.
tf::write_result write(job& work, const tf::mesh_file& file, const tf::write_options& options,
                       const std::filesystem::path& path, double moved, const auto& check) {
    const common_options& o = work.options;
    output_place place(path, o.force || o.in_place);
    tf::write_result written;
    try {
        written = tf::write(place.writable(), file, options);
        check(place.writable(), written);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
    enter_output(work, path, written, moved);
    return written;
}

}  // namespace

written_form form_of(const job& work, const tf::mesh_file& input,
                     const std::filesystem::path& path) {
    const common_options& o = work.options;
    if (!o.in_place) return {mesh_format(o, path), o.ascii};
    const std::string format = input.format.substr(0, input.format.find('-'));
    if (std::find(o.mesh_formats.begin(), o.mesh_formats.end(), format) == o.mesh_formats.end())
        throw failure(bad_output, "output",
                      work.path + ": --in-place cannot write " + input.format + "; use -o");
    return {format, o.ascii || (input.format.ends_with("ascii") && !o.binary)};
}

bool is_single(const tf::mesh_file& file) {
    return file.stored_as == tf::precision::float32 && !is_text(file.format) &&
           tf::fits_float32(file.mesh.points);
}

tf::precision written_precision(const common_options& options,
                                const std::optional<written_form>& form,
                                std::span<const tf::mesh_file* const> inputs) {
    const auto is_kept = [](const tf::mesh_file* file) { return is_single(*file); };
    const bool keeps_single =
        (form && form->single_unless_asked()) || std::ranges::all_of(inputs, is_kept);
    const bool single = (form && form->single_only()) || options.precision == "float" ||
                        (options.precision == "keep" && keeps_single);
    return single ? tf::precision::float32 : tf::precision::float64;
}

tf::write_options write_options_for(const common_options& options, const written_form& form) {
    tf::write_options how{.format = form.format,
                          .ascii = form.ascii,
                          .drop = options.drop,
                          .rename = options.rename,
                          .las_scale = options.las_scale,
                          .las_offset = options.las_offset};
    if (options.precision == "float") how.precision = tf::precision::float32;
    if (options.precision == "double") how.precision = tf::precision::float64;
    return how;
}

void check_outputs(const job& work, std::initializer_list<std::filesystem::path> always,
                   std::initializer_list<std::filesystem::path> also) {
    const common_options& o = work.options;
    const auto check = [&](const std::filesystem::path& path) {
        if (!path.empty()) check_output(path, o.force);
    };
    std::for_each(always.begin(), always.end(), check);
    check(o.html);
    check(o.png);
    if (o.dry_run) return;
    std::for_each(also.begin(), also.end(), check);
    if (const auto path = mesh_output(o, work.path)) check_output(*path, o.force || o.in_place);
}

void warn_of_moves(job& work, tf::points_view points, const tf::certificate& known) {
    const double step = tf::coordinate_step(points, known.precision);
    const double moved = known.max_displacement;
    if (!(moved > step)) return;
    constexpr double most_steps = 1e6;  // more tell nobody anything
    const std::string steps = moved > most_steps * step
                                  ? std::string()
                                  : " (" + brief(std::ceil(moved / step)) + " steps of the " +
                                        numbers_of(known.precision) + " numbers there)";
    work.warn("moved", "points moved by up to " + brief(moved) + steps +
                           " so that no faces meet in the rounded coordinates; --max-move DIST "
                           "sets a limit");
}

void warn_of_rounding(job& work, double max_displacement, const std::string& whose) {
    if (max_displacement > 0.0)
        work.warn("rounded", whose + "written in single precision: coordinates move by up to " +
                                 brief(max_displacement));
}

void warn_of_folds(job& work, const tf::rounding_effects& defects, tf::precision precision) {
    std::string text;
    if (defects.collapsed > 0)
        text = counted(defects.collapsed, "face", "faces") + " lost all area";
    if (defects.meeting > 0)
        text += (text.empty() ? "" : ", ") + counted(defects.meeting, "pair", "pairs") +
                " of faces newly " + (defects.meeting == 1 ? "meets" : "meet");
    if (text.empty()) return;
    work.warn("rounding-defects",
              "by rounding, " + text + "; " +
                  (precision == tf::precision::float32
                       ? "--precision double, in a format that has it, may avoid this"
                       : "coordinates nearer to the origin are rounded less"));
}

void enter_rounding(job& work, const tf::rounding_effects& lost, tf::precision precision) {
    work.entry["rounding"] = {{"max_move", lost.max_displacement},
                              {"step", lost.step},
                              {"collapsed_faces", or_null(lost.compared, lost.collapsed)},
                              {"new_pairs", or_null(lost.compared, lost.meeting)}};
    if (lost.noticeable && precision == tf::precision::float32)
        warn_of_rounding(work, lost.max_displacement);
    else if (lost.noticeable)
        work.warn("rounded", "coordinates move by up to " + brief(lost.max_displacement));
    if (lost.compared)
        warn_of_folds(work, {.collapsed = lost.collapsed, .meeting = lost.meeting}, precision);
}

void warn_of_ambiguous_materials(job& work, std::span<const tf::mesh_file* const> inputs) {
    std::vector<tf::attribute_source> sources;
    for (const tf::mesh_file* input : inputs) sources.push_back({input});
    const std::string text =
        ambiguous_materials_in_words(tf::attribute_sources(std::move(sources)));
    if (!text.empty()) work.warn("materials", text);
}

void enter_output(job& work, const std::filesystem::path& path, const tf::write_result& written,
                  double moved) {
    json& output = work.entry["output"];
    output["file"] = path.string();
    output["format"] = written.format;
    output["precision_out"] = name_of(written.written_as);
    output.emplace("max_move", std::max(moved, written.max_displacement));
    work.warn(written.warnings);
}

tf::mesh_file file_of(tf::mesh&& surface, const tf::certificate& known) {
    tf::mesh_file file{.mesh = std::move(surface)};
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = known.precision;
    return file;
}

tf::write_result write_mesh(job& work, const tf::mesh_file& file, const tf::write_options& options,
                            const std::filesystem::path& path, double moved) {
    return write(work, file, options, path, moved, [](const auto&, const auto&) {});
}

void write_certified(job& work, const tf::mesh_file& file, const written_form& form,
                     const std::filesystem::path& path, double moved) {
    const auto look = [&](const std::filesystem::path& there, const tf::write_result& written) {
        look_again(there, form.format, file.mesh);
        if (written.max_displacement > 0.0)
            throw std::logic_error("coordinates were rounded that had been certified");
    };
    write(work, file, {.format = form.format, .ascii = form.ascii, .precision = file.stored_as},
          path, moved, look);
}

}  // namespace tools
