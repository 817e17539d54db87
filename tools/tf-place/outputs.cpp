#include "tools/common/console.hpp"
#include "tools/common/material_words.hpp"
#include "tools/common/mesh_output.hpp"
#include "tools/common/output_file.hpp"
#include "tools/tf-place/outcome.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

namespace tools {
namespace {

/// The classes of all faces that are written.
std::vector<tf::contact_class> classes_of(const body& moving, const body_set& fixed,
                                          const tf::contact_classes& found, bool scene) {
    std::vector<tf::classified_body> bodies{{moving.file.get(), &moving.is, found.moving}};
    for (std::size_t i = 0; i < fixed.bodies.size() && scene; ++i)
        bodies.push_back({fixed.bodies[i].file.get(), &fixed.bodies[i].is, found.fixed[i]});
    return tf::classes_in_files(bodies);
}

}  // namespace

tf::precision precision_of(const job& work, const tf::mesh_file& file) {
    const auto path = mesh_output(work.options, work.path);
    const tf::mesh_file* const input = &file;
    if (!path) return tf::precision::float64;
    return written_precision(work.options, form_of(work, file, *path), {&input, 1});
}

void write_matrix(const job& work, const place_settings& settings, const std::string& text) {
    write_file(settings.matrix, work.options.force, work.keeper,
               [&](output_file& file) { file.write(text); });
}

void enter_rounding(job& work, const body_set& moving, std::span<const placed_body> placed,
                    tf::precision precision) {
    if (placed.empty()) return;
    tf::rounding_effects sum;
    {
        const auto timing = work.time("settle");
        for (const placed_body& at : placed) {
            const bool was_single = is_single(*moving.bodies[at.number].file);
            sum += tf::effects_of_rounding(
                moving.shapes[at.number], at.matrix, at.points,
                {.before = was_single ? tf::precision::float32 : tf::precision::float64,
                 .after = precision,
                 .progress = work.progress("rounding")});
            work.call_ended();
        }
    }
    work.entry["rounding"] = {{"max_move", sum.max_displacement},
                              {"step", sum.step},
                              {"collapsed_faces", or_null(sum.compared, sum.collapsed)},
                              {"new_pairs", or_null(sum.compared, sum.meeting)}};
    if (sum.noticeable && precision == tf::precision::float32)
        warn_of_rounding(work, sum.max_displacement);
    else if (sum.noticeable)
        work.warn("rounded", "coordinates move by up to " + shortest(sum.max_displacement));
    if (sum.compared)
        warn_of_folds(work, {.collapsed = sum.collapsed, .meeting = sum.meeting}, precision);
}

void put_back(body_set& moving, std::span<const placed_body> placed, tf::precision precision) {
    for (const placed_body& at : placed) {
        const body& b = moving.bodies[at.number];
        tf::put_back(*b.file, b.is, moving.shapes[at.number], at.points, at.matrix, precision);
        tf::transform_normals(*b.file, at.all_moves);
    }
}

tf::mesh_file scene_of(job& work, std::span<const body* const> bodies, const std::string& format) {
    std::vector<tf::scene_member> members;
    std::vector<const tf::mesh_file*> files;
    for (const body* b : bodies) {
        if (!files.empty() && files.back() == b->file.get()) continue;
        files.push_back(b->file.get());
        members.push_back({b->file.get(), stem_of(b->path), name_of_input(b->path)});
    }
    tf::mesh_file scene = tf::scene_of(members);
    work.warn(scene.warnings);
    if (format == "obj") warn_of_ambiguous_materials(work, files);
    return scene;
}

void write(job& work, const tf::mesh_file& file, const written_form& form,
           const std::filesystem::path& path, tf::precision precision, bool scene) {
    const auto written = write_mesh(
        work, file, {.format = form.format, .ascii = form.ascii, .precision = precision}, path);
    work.entry["output"]["scene"] = scene;
    warn_of_rounding(work, written.max_displacement);  // of measure, and of what is fixed
}

void write_result(job& work, body_set& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& all_moves) {
    const auto path = mesh_output(work.options, work.path);
    if (!path) return;
    const body& one = moving.bodies[0];
    const tf::placement& p = found.at;
    const placed_body placed{0, p.points, p.matrix, all_moves};
    const bool picture = settings.mode == place_mode::measure;
    if (!picture) enter_rounding(work, moving, {&placed, 1}, p.certificate.precision);
    if (work.options.dry_run) return;
    const written_form form = form_of(work, *one.file, *path);
    // `fit` looks at no faces, and without fixed meshes there is nothing to meet.
    const bool colors = !settings.fixed.empty() && settings.mode != place_mode::fit &&
                        (form.format == "ply" || form.format == "glb");
    tf::contact_classes met;
    if (colors) met = tf::classify_contacts(moving.shapes[0], fixed.shapes, p);
    put_back(moving, {&placed, 1}, p.certificate.precision);
    std::vector<const body*> all{&one};
    for (const body& part : fixed.bodies) all.push_back(&part);
    tf::mesh_file file = settings.scene ? scene_of(work, all, form.format) : *one.file;
    // What has been moved stays what it is, with its polygons, and its colors where it has some.
    const bool as_it_is = !picture && !settings.scene;
    if (colors)
        tf::color_contacts(file, classes_of(one, fixed, met, settings.scene),
                           {.split_polygons = picture && !settings.scene, .keep_colors = as_it_is});
    write(work, file, form, *path, p.certificate.precision, settings.scene);
}

}  // namespace tools
