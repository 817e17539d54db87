#include "tools/tf-place/outputs.hpp"

#include "tools/common/console.hpp"
#include "tools/common/folds.hpp"
#include "tools/common/output_file.hpp"
#include "tools/common/scene_file.hpp"
#include "tools/common/written_form.hpp"
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>

namespace tools {
namespace {

/// Adds the classes of the faces of `b`, whose file's rows follow those in `all` before `first`.
void add_classes(std::vector<tf::contact_class>& all, std::size_t first, const body& b,
                 const std::vector<tf::contact_class>& faces) {
    all.resize(first + (b.cloud ? b.file->mesh.points.size() : b.file->mesh.faces.size()));
    for (std::uint32_t f = 0; f < faces.size(); ++f) all[first + b.is.triangle(f)] = faces[f];
}

/// Of a scene, the classes of all files follow each other as its faces do; clouds have none there.
std::vector<tf::contact_class> classes_of(const body& moving, const body_set& fixed,
                                          const tf::contact_classes& found, bool scene) {
    std::vector<tf::contact_class> all;
    if (!scene || !moving.cloud) add_classes(all, 0, moving, found.moving);
    std::size_t first = 0;
    for (std::size_t i = 0; i < fixed.bodies.size() && scene; ++i) {
        const body& b = fixed.bodies[i];
        if (i == 0 || fixed.bodies[i - 1].file_number != b.file_number) first = all.size();
        if (!b.cloud) add_classes(all, first, b, found.fixed[i]);
    }
    return all;
}

/// Writes `file` and says so in the report.
void write_file(job& work, const tf::mesh_file& file, const std::filesystem::path& path,
                const written_form& form, tf::precision precision, bool scene) {
    const common_options& o = work.options;
    output_place place(path, o.force || o.in_place, work.keeper);
    tf::write_result written;
    try {
        written = tf::write(place.writable(), file,
                            {.format = form.format, .ascii = form.ascii, .precision = precision});
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
    work.entry["output"] = {
        {"file", path.string()},
        {"format", written.format},
        {"precision_out", written.written_as == tf::precision::float32 ? "float" : "double"},
        {"max_move", written.max_displacement},
        {"scene", scene}};
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
    if (written.max_displacement > 0.0)  // of measure, which moves nothing, and of what is fixed
        work.warn("rounded", "written in single precision: coordinates move by up to " +
                                 shortest(written.max_displacement));
}

}  // namespace

void check_outputs(const job& work, const place_settings& settings) {
    const common_options& o = work.options;
    if (!settings.matrix.empty()) check_output(settings.matrix, o.force);
    if (o.dry_run) return;
    if (const auto path = mesh_output(o, work.path)) check_output(*path, o.force || o.in_place);
}

tf::precision precision_of(const job& work, const tf::mesh_file& file) {
    const auto path = mesh_output(work.options, work.path);
    const tf::mesh_file* const input = &file;
    const bool single =
        path && writes_single(work.options, form_of(work, file, *path), {&input, 1});
    return single ? tf::precision::float32 : tf::precision::float64;
}

void write_matrix(const job& work, const std::filesystem::path& path, const std::string& text) {
    output_file file(path, work.options.force, work.keeper);
    file.write(text);
    file.commit();
}

tf::rounding_effects look_at_rounding(job& work, const body_set& moving, std::size_t i,
                                      const tf::transform<3>& matrix, tf::points_view placed,
                                      tf::precision precision) {
    const auto timing = work.time("settle");
    const bool was_single = is_single(*moving.bodies[i].file);
    const auto found = tf::effects_of_rounding(
        moving.shapes[i], matrix, placed,
        {.before = was_single ? tf::precision::float32 : tf::precision::float64,
         .after = precision,
         .progress = work.progress("rounding")});
    work.out.end_progress();
    work.keeper.check();
    return found;
}

void enter_rounding(job& work, std::span<const tf::rounding_effects> all, tf::precision precision) {
    tf::rounding_effects sum;
    for (const tf::rounding_effects& one : all) sum += one;
    const bool single = precision == tf::precision::float32;
    work.entry["rounding"] = {
        {"max_move", sum.max_displacement},
        {"step", sum.step},
        {"collapsed_faces", sum.compared ? json(sum.collapsed) : json(nullptr)},
        {"new_pairs", sum.compared ? json(sum.meeting) : json(nullptr)}};
    if (sum.noticeable)
        work.warn("rounded", std::string(single ? "written in single precision: " : "") +
                                 "coordinates move by up to " + shortest(sum.max_displacement));
    if (sum.compared)
        warn_of_folds(work, {.collapsed = sum.collapsed, .meeting = sum.meeting}, single);
}

void put_back(body_set& moving, std::size_t i, tf::points_view placed,
              const tf::transform<3>& matrix, const tf::transform<3>& all_moves,
              tf::precision precision) {
    tf::mesh_file& file = *moving.bodies[i].file;
    tf::put_back(file, moving.bodies[i].is, moving.shapes[i], placed, matrix, precision);
    tf::transform_normals(file, all_moves);
}

void write_result(job& work, body_set& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& all_moves) {
    const auto path = mesh_output(work.options, work.path);
    if (!path) return;
    const body& one = moving.bodies[0];
    const tf::placement& p = found.at;
    const bool picture = settings.mode == place_mode::measure;
    if (!picture)
        enter_rounding(
            work,
            std::array{look_at_rounding(work, moving, 0, p.matrix, p.points, found.precision)},
            found.precision);
    if (work.options.dry_run) return;
    const written_form form = form_of(work, *one.file, *path);
    // `fit` looks at no faces, and without fixed meshes there is nothing to meet.
    const bool colors = !settings.fixed.empty() && settings.mode != place_mode::fit &&
                        (form.format == "ply" || form.format == "glb");
    tf::contact_classes met;
    if (colors) met = tf::classify_contacts(moving.shapes[0], fixed.shapes, p);
    put_back(moving, 0, p.points, p.matrix, all_moves, found.precision);
    std::vector<scene_input> all{{one.path, one.file.get()}};
    for (const body& part : fixed.bodies)
        if (part.file.get() != all.back().file) all.push_back({part.path, part.file.get()});
    tf::mesh_file file = settings.scene ? scene_of(work, all, form.format) : *one.file;
    // What has been moved stays what it is, with its polygons, and its colors where it has some.
    const bool as_it_is = !picture && !settings.scene;
    if (colors)
        tf::color_contacts(file, classes_of(one, fixed, met, settings.scene),
                           {.split_polygons = picture && !settings.scene, .keep_colors = as_it_is});
    write_file(work, file, *path, form, found.precision, settings.scene);
}

void write_plate(job& work, const body_set& parts, const std::vector<bool>& placed,
                 tf::precision precision) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || work.options.dry_run) return;
    std::vector<scene_input> there;
    for (std::size_t i = 0; i < parts.bodies.size(); ++i)
        if (placed[i]) there.push_back({parts.bodies[i].path, parts.bodies[i].file.get()});
    if (there.empty()) return;
    const written_form form = form_of(work, *there[0].file, *path);
    write_file(work, scene_of(work, there, form.format), *path, form, precision, true);
}

}  // namespace tools
