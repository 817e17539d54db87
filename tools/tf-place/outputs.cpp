#include "tools/shell/mesh_output.hpp"
#include "tools/tf-place/place.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <vector>

namespace tools {
namespace {

/// What points lose at their places.
tf::rounding_effects rounding_of(job& work, const tf::body_set& moving,
                                 const std::vector<placed_body>& placed, tf::precision precision) {
    const auto timing = work.time("round");
    tf::rounding_effects sum;
    for (const placed_body& at : placed) {
        const bool was_single = is_single(moving.file_of(at.number).content);
        sum +=
            tf::find_rounding_effects(moving.shapes[at.number], at.matrix, at.points,
                                      was_single ? tf::precision::float32 : tf::precision::float64,
                                      precision, work.progress("rounding"));
        work.call_ended();
    }
    return sum;
}

}  // namespace

void write_result(job& work, const place_settings& settings, tf::body_set& moving,
                  const std::vector<placed_body>& placed, const tf::body_set& fixed,
                  const tf::placement& met) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || placed.empty()) return;
    const tf::precision precision = met.certificate.precision;
    const bool picture = settings.mode == place_mode::measure;
    const bool scene = settings.scene || settings.mode == place_mode::pack;
    tf::rounding_effects lost;
    if (!picture) {
        lost = rounding_of(work, moving, placed, precision);
        enter_rounding(work, lost, precision);
    }
    if (work.options.dry_run) return;
    std::vector<const tf::mesh_file*> files;
    std::vector<std::string> names, labels;
    const auto add = [&](const tf::body_file& file) {
        files.push_back(&file.content);
        names.push_back(file.name);
        labels.push_back(file.label);
    };
    for (const placed_body& at : placed) {
        moving.move_in_file(at.number, at.points, at.matrix, precision);
        tf::body_file& file = moving.files[moving.file_number(at.number)];
        file.content.transform_normals(at.matrix);
        add(file);
    }
    std::for_each(fixed.files.begin(), fixed.files.end(), add);
    const written_form form = form_of(work, *files[0], *path);
    tf::mesh_file file = scene ? tf::scene_of(files, names, labels) : *files[0];
    if (scene) work.warn(file.warnings);
    if (scene && form.format == "obj") warn_of_ambiguous_materials(work, files);
    // `align` looks at no faces, and without fixed meshes there is nothing to meet.
    if (!fixed.files.empty() && settings.mode != place_mode::align &&
        (form.format == "ply" || form.format == "glb")) {
        const auto of_bodies = met.face_relations(moving.shapes[0], fixed.shapes);
        auto relations = moving.relations_in_files(std::span(of_bodies).first(1), !scene);
        if (scene) {
            const auto more = fixed.relations_in_files(std::span(of_bodies).subspan(1), false);
            relations.insert(relations.end(), more.begin(), more.end());
        }
        // What has been moved stays what it is, with its polygons, and its colors where it has
        // some.
        if (picture && !scene) file.split_polygons();
        tf::placement::color(
            file, relations,
            0.02 * tf::bounding_box(file.mesh.points).value_or(tf::box3{}).diagonal(),
            !picture && !scene);
    }
    const auto written =
        write_mesh(work, file, {.format = form.format, .ascii = form.ascii, .precision = precision},
                   *path, lost.max_displacement);
    work.entry["output"]["scene"] = scene;
    warn_of_rounding(work, written.max_displacement);  // of measure, and of what is fixed
}

}  // namespace tools
