#include "tools/tf-place/outputs.hpp"

#include "tools/common/console.hpp"
#include "tools/common/material_words.hpp"
#include "tools/common/output_file.hpp"
#include "tools/common/written_form.hpp"
#include "tools/tf-place/marks.hpp"
#include "tools/tf-place/rounding.hpp"
#include "tools/tf-place/words.hpp"
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/io_error.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace tools {
namespace {

json triple(const tf::point3& p) { return {p.x, p.y, p.z}; }

json box_entry(const std::optional<tf::box3>& box) {
    if (!box) return nullptr;
    return {{"min", triple(box->min)}, {"max", triple(box->max)}};
}

void extend(std::optional<tf::box3>& box, const std::optional<tf::box3>& more) {
    if (box && more)
        box = tf::bounding_box(std::array{box->min, box->max, more->min, more->max});
    else if (more)
        box = more;
}

json side_entry(const body& b, const tf::surface_point& at) {
    json entry{{"point", triple(at.point)}};
    entry["face"] = b.cloud ? json(nullptr) : json(b.stored_face(at.face));
    entry["triangle"] = b.cloud ? json(nullptr) : json(b.triangle(at.face));
    entry["barycentric"] = b.cloud ? json(nullptr) : json(at.barycentric);
    entry["vertex"] = b.cloud ? json(b.triangle(at.face)) : json(nullptr);
    return entry;
}

json name_entry(const body& b) { return b.part.empty() ? json(nullptr) : json(b.part); }

json closest_entry(const body& moving, const nearest_part& near, const surroundings& among) {
    const body& part = among.all()[near.part];
    json fixed = side_entry(part, near.how.on_b);
    fixed["file"] = part.path;
    fixed["part"] = part.file_number;
    fixed["name"] = name_entry(part);
    return {{"moving", side_entry(moving, near.how.on_a)}, {"fixed", std::move(fixed)}};
}

json contacts_entry(const body& moving, const std::vector<contact_row>& contacts,
                    const surroundings& among) {
    json rows = json::array();
    for (const contact_row& c : contacts) {
        const body* const part = c.fixed ? &among.all()[c.part] : nullptr;
        rows.push_back({{"point", triple(c.point)},
                        {"normal", triple(c.normal)},
                        {"moving", moving.stored_face(c.moving)},
                        {"fixed", part ? json(part->stored_face(*c.fixed)) : json(nullptr)},
                        {"part", part ? json(part->file_number) : json("bed")},
                        {"name", part ? name_entry(*part) : json(nullptr)}});
    }
    return rows;
}

json matrix_entry(const tf::transform<3>& matrix) {
    json rows = json::array();
    for (const auto& row : matrix.rows) rows.push_back(row);
    rows.push_back({0.0, 0.0, 0.0, 1.0});
    return rows;
}

json inside_entry(const placement& p) {
    if (!p.nearest) return nullptr;
    const auto& how = p.nearest->how.relation;
    return how.a_inside_b ? json("moving") : how.b_inside_a ? json("fixed") : json(nullptr);
}

/// The faces were not looked at: nothing is said of how they lie to each other.
void enter_fit(job& work, const tf::fit_result& fit) {
    json& entry = work.entry;
    for (const char* key : {"status", "status_at_start", "contact_count"}) entry[key] = nullptr;
    for (const char* key : {"travel", "backed_off"}) entry[key] = nullptr;
    entry["fit"] = {{"rms", fit.rms},
                    {"rms_at_start", fit.rms_at_start},
                    {"overlap", fit.overlap},
                    {"scale", fit.scale},
                    {"converged", fit.converged},
                    {"iterations", fit.iterations},
                    {"pivot", triple(fit.pivot)},
                    {"pivot_moved", triple(fit.pivot_moved)}};
}

/// The parts of a body's file in a scene, to be known there by the names they have, or by the
/// file's where it has one part.
std::vector<tf::part> parts_in_scene(const body& b, std::vector<tf::part> parts) {
    const std::string file_name = std::filesystem::path(b.name()).stem().string();
    const bool one = std::all_of(parts.begin(), parts.end(), [&](const tf::part& p) {
        return p.object == parts[0].object && p.group == parts[0].group;
    });
    for (tf::part& p : parts)
        if (one) p = {.object = file_name, .material = p.material, .first_face = p.first_face};
    if (parts.empty() || parts[0].first_face > 0)
        parts.insert(parts.begin(), {.object = file_name});
    if (one)
        parts.erase(std::unique(parts.begin(), parts.end(),
                                [](const tf::part& p, const tf::part& q) {
                                    return p.material == q.material;
                                }),
                    parts.end());
    return parts;
}

/// What a scene takes of a body's file, but for points and faces.
tf::mesh_file described(const body& b) {
    tf::mesh_file one{.stored_face = b.file->stored_face, .stored_faces = b.file->stored_faces};
    const tf::attributes& all = b.file->attributes;
    one.attributes = {.corners = all.corners,
                      .parts = all.parts,
                      .material_files = all.material_files,
                      .texture_files = all.texture_files};
    if (const tf::column* numbers = tf::texture_numbers(*b.file))
        one.attributes.elements = {{"face", one.stored_faces, {*numbers}}};
    return one;
}

/// The files of `bodies` with one list of texture files.
std::vector<tf::mesh_file> described(job& work, const std::vector<const body*>& bodies,
                                     const std::string& format) {
    std::vector<tf::mesh_file> all;
    std::vector<std::string> names;
    for (const body* b : bodies) {
        all.push_back(described(*b));
        names.push_back(name_of_input(b->path));
    }
    std::vector<tf::mesh_file*> files;
    for (tf::mesh_file& one : all) files.push_back(&one);
    for (const tf::io_warning& w : tf::unite_textures(files, names)) work.warn(w.code, w.text);
    if (format == "obj")
        warn_of_ambiguous_materials(work,
                                    std::vector<const tf::mesh_file*>(files.begin(), files.end()));
    return all;
}

/// Gives the faces of `scene` that come next, `faces` in number, the numbers of `one`.
void append_texture_numbers(tf::mesh_file& scene, const tf::mesh_file& one, std::size_t faces) {
    const tf::column* const more = tf::texture_numbers(one);
    if (more == nullptr || scene.attributes.texture_files.empty()) return;
    tf::element& rows = tf::obtain_element(scene.attributes, "face", 0);
    rows.rows += faces;
    if (rows.columns.empty()) return rows.columns.push_back(*more);
    auto& values = rows.columns[0].values;
    values.insert(values.end(), more->values.begin(), more->values.end());
}

/// All together, with the parts of their files, what their corners have, its materials and
/// textures. Other properties are left out.
tf::mesh_file scene_of(job& work, const std::vector<const body*>& bodies,
                       const std::string& format) {
    tf::mesh_file scene;
    scene.format = bodies[0]->file->format;
    scene.stored_as = bodies[0]->file->stored_as;
    const auto add = [&](const body& b, tf::mesh_file one) {
        const tf::mesh& mesh = b.file->mesh;
        tf::split_polygons(one);
        append_texture_numbers(scene, one, mesh.faces.size());
        const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
        const auto first_face = static_cast<std::uint32_t>(scene.mesh.faces.size());
        for (tf::part& p : parts_in_scene(b, std::move(one.attributes.parts))) {
            p.first_face += first_face;
            scene.attributes.parts.push_back(std::move(p));
        }
        tf::append(scene.attributes.corners, first_face, one.attributes.corners, mesh.faces.size());
        auto& names = scene.attributes.material_files;
        for (const std::string& name : one.attributes.material_files)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        scene.mesh.points.insert(scene.mesh.points.end(), mesh.points.begin(), mesh.points.end());
        for (const tf::face& f : mesh.faces)
            scene.mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    };
    std::vector<tf::mesh_file> files = described(work, bodies, format);
    scene.attributes.texture_files = files[0].attributes.texture_files;
    for (std::size_t i = 0; i < bodies.size(); ++i) add(*bodies[i], std::move(files[i]));
    scene.stored_faces = scene.mesh.faces.size();
    return scene;
}

/// Writes `file` and says so in the report.
void write_file(job& work, const tf::mesh_file& file, const std::filesystem::path& path,
                const written_form& form, bool to_single, bool scene) {
    const common_options& o = work.options;
    const tf::write_options options{
        .format = form.format,
        .ascii = form.ascii,
        .precision = to_single ? tf::precision::float32 : tf::precision::float64};
    output_place place(path, o.force || o.in_place, work.keeper);
    tf::write_result written;
    try {
        written = tf::write_mesh(place.writable(), file, options);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
    work.entry["output"] = {
        {"file", path.string()},
        {"format", written.format},
        {"precision_out", written.written_as == tf::precision::float32 ? "float" : "double"},
        {"max_move", written.largest_move},
        {"scene", scene}};
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
    if (written.largest_move > 0.0)  // of measure, which moves nothing, and of what is fixed
        work.warn("rounded", "written in single precision: coordinates move by up to " +
                                 shortest(written.largest_move));
}

/// Of a scene, the classes of all files follow each other as its faces do; clouds have none there.
void color_scene(tf::mesh_file& file, const body& moving, const std::vector<body>& fixed,
                 const all_classes& classes) {
    face_classes all;
    const auto add = [&](const body& b, const face_classes& more) {
        if (!b.cloud) all.insert(all.end(), more.begin(), more.end());
    };
    add(moving, classes.moving);
    for (std::size_t i = 0; i < fixed.size(); ++i)
        if (i == 0 || fixed[i].file_number != fixed[i - 1].file_number)
            add(fixed[i], classes.fixed[fixed[i].file_number]);
    set_classes(file, "face", all, false);
}

/// What `measure` writes is a picture: every triangle has its own colour. What has been moved stays
/// what it is, with its polygons, and its colours where it has some.
void color_moving(tf::mesh_file& file, bool cloud, const face_classes& classes, bool picture) {
    if (cloud) return set_classes(file, "vertex", classes, !picture);
    if (picture) {
        tf::split_polygons(file);
        set_classes(file, "face", classes, false);
    } else {
        set_classes(file, "face", by_stored_face(file, classes), true);
    }
}

/// `fit` looks at no faces, and without fixed meshes there is nothing to meet.
bool has_classes(const place_settings& settings, const std::string& format) {
    return !settings.fixed.empty() && settings.mode != place_mode::fit &&
           (format == "ply" || format == "glb");
}

}  // namespace

void check_outputs(const job& work, const place_settings& settings) {
    const common_options& o = work.options;
    if (!settings.matrix.empty()) check_output(settings.matrix, o.force);
    if (o.dry_run) return;
    if (const auto path = mesh_output(o, work.path)) check_output(*path, o.force || o.in_place);
}

bool writes_single(const job& work, const tf::mesh_file& file) {
    const auto path = mesh_output(work.options, work.path);
    const tf::mesh_file* const input = &file;
    return path && writes_single(work.options, form_of(work, file, *path), {&input, 1});
}

void enter_blank_report(job& work, const place_settings& settings) {
    json& entry = work.entry;
    for (const char* key : {"format", "sha256", "precision_in", "faces", "triangles", "box"})
        entry[key] = nullptr;
    entry["mode"] = name_of(settings.mode);
    entry["fixed"] = json::array();
    entry["skipped"] = {{"non_finite", nullptr},          {"parts_not_loaded", 0},
                        {"parts_not_indexed", nullptr},   {"primitives_not_indexed", nullptr},
                        {"pairs_culled_by_box", nullptr}, {"face_pairs_in_motion", nullptr},
                        {"filter_calls", nullptr},        {"exact_calls", nullptr}};
    entry["clearance"] = {{"given", settings.clearance.given}, {"used", nullptr}};
    entry["max_travel"] = settings.max_travel ? json(settings.max_travel->given) : json(nullptr);
    for (const char* key :
         {"bed", "placed", "reason", "status_at_start", "status", "inside", "distance",
          "surface_distance", "closest", "direction", "travel", "backed_off", "matrix"})
        entry[key] = nullptr;
    entry["contacts"] = json::array();
    entry["contact_count"] = nullptr;
    entry["sides"] = json::array();
    for (const char* key : {"chosen", "corrected", "fit", "fits"}) entry[key] = nullptr;
    entry["tolerance"] = {
        {"given", settings.mode == place_mode::lay ? json(settings.flatness.given) : json(nullptr)},
        {"used", nullptr}};
    entry["parts"] = json::array();
    entry["not_placed"] = json::array();
    entry["rounding"] = nullptr;
    entry["matrix_file"] = settings.matrix.empty() ? json(nullptr) : json(settings.matrix.string());
    entry["output"] = nullptr;
}

void enter_bodies(job& work, const body& moving, const surroundings& among) {
    json& entry = work.entry;
    entry["faces"] = moving.file->stored_faces;
    entry["triangles"] = moving.file->mesh.faces.size();
    entry["box"] = box_entry(moving.box);
    std::uint64_t non_finite = moving.non_finite;
    std::vector<std::optional<tf::box3>> boxes(entry["fixed"].size());
    for (const body& part : among.all()) {
        json& one = entry["fixed"][part.file_number];
        one["faces"] = part.file->stored_faces;
        extend(boxes[part.file_number], part.box);
        one["box"] = box_entry(boxes[part.file_number]);
        non_finite += part.non_finite;
    }
    entry["skipped"]["non_finite"] = non_finite;
}

void enter_report(job& work, const body& moving, const placement& p, const surroundings& among,
                  const tf::transform<3>& matrix) {
    json& entry = work.entry;
    const std::uint64_t parts = among.all().size();
    entry["skipped"]["parts_not_indexed"] = parts - among.indexed();
    std::uint64_t faces = 0;
    for (const body& part : among.all())
        if (!part.tree) faces += part.face_count();
    entry["skipped"]["primitives_not_indexed"] = faces;
    entry["skipped"]["pairs_culled_by_box"] = p.skipped.parts_culled;
    entry["skipped"]["face_pairs_in_motion"] = p.skipped.pairs_tested;
    entry["skipped"]["filter_calls"] = p.skipped.predicates.calls;
    entry["skipped"]["exact_calls"] = p.skipped.predicates.undecided;
    for (json& one : entry["fixed"]) {
        one["indexed"] = false;
        one["parts"] = json::array();
    }
    for (const body& part : among.all()) {
        json& one = entry["fixed"][part.file_number];
        const bool indexed = part.tree != nullptr;
        if (indexed) one["indexed"] = true;
        if (part.part.empty()) continue;
        one["parts"].push_back({{"name", part.part},
                                {"triangles", part.face_count()},
                                {"box", box_entry(part.box)},
                                {"indexed", indexed}});
    }
    entry["clearance"]["used"] = p.clearance;
    if (p.bed)
        entry["bed"] = {{"given", p.bed->given}, {"used", p.bed->used}, {"reached", p.on_bed}};
    entry["placed"] = p.placed;
    if (!p.placed) entry["reason"] = p.reason;
    entry["status_at_start"] = name_of(p.status_at_start);
    entry["status"] = name_of(p.status);
    entry["inside"] = inside_entry(p);
    entry["contacts"] = contacts_entry(moving, p.contacts, among);
    entry["contact_count"] = p.contact_count;
    if (p.nearest) {
        entry["distance"] = p.nearest->how.distance;
        entry["surface_distance"] = p.nearest->how.surface_distance;
        entry["closest"] = closest_entry(moving, *p.nearest, among);
    }
    if (!p.placed) {
        entry["not_placed"].push_back(work.entry["input"]);
        return;
    }
    entry["direction"] = p.travel > 0.0 ? triple(p.direction) : json(nullptr);
    entry["travel"] = p.travel;
    entry["backed_off"] = p.backed_off;
    entry["matrix"] = matrix_entry(matrix);
    for (const tf::hull_side& side : p.sides)
        entry["sides"].push_back({{"normal", triple(side.normal)},
                                  {"area", side.area},
                                  {"center", triple(side.centre)}});
    if (!p.sides.empty()) {
        entry["chosen"] = p.chosen;
        entry["tolerance"]["used"] = p.tolerance;
        entry["corrected"] = p.corrected;
    }
    if (p.fit) enter_fit(work, *p.fit);
}

void write_matrix(const job& work, const std::filesystem::path& path,
                  const tf::transform<3>& matrix) {
    output_file file(path, work.options.force, work.keeper);
    file.write(matrix_text(matrix));
    file.commit();
}

void write_result(job& work, body& moving, const placement& p, const surroundings& among,
                  const place_settings& settings, const tf::transform<3>& all_moves,
                  bool to_single) {
    const common_options& o = work.options;
    const auto path = mesh_output(o, work.path);
    if (!path) return;
    if (settings.mode != place_mode::measure)
        enter_rounding(work, {look_at_rounding(work, moving, p.matrix, p.points, to_single)},
                       to_single);
    if (o.dry_run) return;
    const written_form form = form_of(work, *moving.file, *path);
    std::optional<all_classes> classes;
    if (has_classes(settings, form.format)) classes = classify_faces(moving, among, p);
    take_places(moving, p.points, p.matrix, to_single);
    tf::transform_normals(*moving.file, all_moves);
    std::vector<const body*> bodies{&moving};
    for (const body& part : among.all())
        if (part.file != bodies.back()->file) bodies.push_back(&part);
    tf::mesh_file file = settings.scene ? scene_of(work, bodies, form.format) : *moving.file;
    if (classes && settings.scene) color_scene(file, moving, among.all(), *classes);
    if (classes && !settings.scene)
        color_moving(file, moving.cloud, classes->moving, settings.mode == place_mode::measure);
    write_file(work, file, *path, form, to_single, settings.scene);
}

void write_plate(job& work, const std::vector<body>& bodies, const std::vector<bool>& placed,
                 bool to_single) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || work.options.dry_run) return;
    std::vector<const body*> there;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (placed[i]) there.push_back(&bodies[i]);
    if (there.empty()) return;
    const written_form form = form_of(work, *there[0]->file, *path);
    write_file(work, scene_of(work, there, form.format), *path, form, to_single, true);
}

}  // namespace tools
