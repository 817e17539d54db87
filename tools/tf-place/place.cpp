#include "tools/tf-place/place.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tools {
namespace {

// ---- what is read ----

/// Says what is left out. \throws failure (bad_input) when there is nothing to place
const tf::body_file& checked(job& work, const tf::body_file& file) {
    work.warn_of_non_finite(file.non_finite, file.cloud ? "point" : "face",
                            file.cloud ? "points" : "faces", file.label + ": ");
    if (!file.box)
        throw failure(bad_input, "no-triangles",
                      file.label + ": no triangle with finite coordinates (" +
                          counted(file.content.mesh.points.size(), "point", "points") + ")");
    return file;
}

/// Adds what was read from `path`, moved by `start`, as one body.
const tf::body_file& add_moving(job& work, const std::string& path, tf::mesh_file file,
                                const tf::transform<3>& start, tf::body_set& moving) {
    const auto timing = work.time("prepare");
    if (start != tf::transform<3>{}) file.move(start);
    return checked(work, moving.add(std::move(file), name_of_input(path), stem_of(path)));
}

void read_fixed(job& work, const place_settings& settings, bool as_single, fixed_meshes& fixed) {
    if (fixed.as_single == as_single) return;
    fixed = {};
    for (const std::string& path : settings.fixed) {
        json about{{"input", path}};
        tf::mesh_file file = work.read(path, about);
        const std::string label = name_of_input(path);
        work.warn(file.warnings, label + ": ");
        if (as_single) warn_of_rounding(work, file.round_to_float32(), label + ": ");
        const auto timing = work.time("prepare");
        // Alignment is to all of a file, which may be a cloud.
        const auto add =
            settings.mode == place_mode::align ? &tf::body_set::add : &tf::body_set::add_parts;
        const tf::body_file& added =
            checked(work, (fixed.bodies.*add)(std::move(file), label, stem_of(path)));
        about.update({{"faces", added.content.stored_faces}, {"box", added.box}});
        fixed.entries.push_back(std::move(about));
    }
    fixed.as_single = as_single;
}

/// With what numbers the mesh made of these files will be written.
tf::precision precision_of(const job& work, const tf::body_set& moving) {
    const auto path = mesh_output(work.options, work.path);
    if (!path) return tf::precision::float64;
    std::vector<const tf::mesh_file*> inputs;
    for (const tf::body_file& file : moving.files) inputs.push_back(&file.content);
    return written_precision(work.options, form_of(work, *inputs[0], *path), inputs);
}

/// The bed. \throws failure (bad_usage) where what is so far above it is not to be written
double bed_of(const place_settings& settings, tf::precision precision, double above = 0.0) {
    const double bed = settings.bed.value_or(0.0);
    if (precision == tf::precision::float64 ||
        std::abs(bed + above) <= double{std::numeric_limits<float>::max()})
        return bed;
    refuse("--bed: " + shortest(bed + above) +
           " is beyond the range of the float32 coordinates that are written; write a text format, "
           "or PLY with --precision double");
}

// ---- one MOVING after the other ----

tf::placement lay(placing& p, const tf::progress_callback& progress) {
    tf::lay_flat_options options = p.settings.lay.options;
    options.bed = bed_of(p.settings, p.precision);
    options.precision = p.precision;
    options.tolerance = p.used(p.settings.lay.flatness);
    options.progress = progress;
    p.laid = tf::lay_flat(p.moving.shapes[0], options);
    if (p.laid) return p.laid->as_placement();
    p.reason = "it has no side, since all its points are on a line";
    return {.certificate = {.status = tf::status::no_placement}};
}

tf::placement align(placing& p, const tf::progress_callback& progress) {
    tf::align_options options = p.settings.align;
    if (p.settings.max_distance) options.max_distance = p.used(*p.settings.max_distance);
    options.precision = p.precision;
    options.progress = progress;
    p.aligned = tf::align(p.moving.shapes[0], p.fixed.shapes[0], options);
    return p.aligned->as_placement();
}

tf::placement turn(placing& p, double clearance, const tf::progress_callback& progress) {
    return tf::turn(p.moving.shapes[0], p.fixed.shapes, p.settings.turn.origin,
                    p.settings.turn.axis,
                    {.clearance = clearance,
                     .max_angle = p.settings.turn.max_angle,
                     .precision = p.precision,
                     .progress = progress});
}

tf::placement mate(placing& p, double clearance, const tf::progress_callback& progress) {
    p.mated = mate_by_features(p.settings.feature, p.moving, p.fixed,
                               {.clearance = clearance,
                                .flip = p.settings.feature.flip,
                                .precision = p.precision,
                                .progress = progress},
                               p.reason);
    if (p.mated) return std::move(p.mated->found);
    return {.certificate = {.status = tf::status::no_placement},
            .outcome = tf::placement_outcome::nothing_met};
}

/// Calls the verb of the mode.
tf::placement search(placing& p, const tf::progress_callback& progress) {
    const place_settings& s = p.settings;
    const tf::prepared_mesh& mesh = p.moving.shapes[0];
    const auto& fixed = p.fixed.shapes;
    const double clearance = p.used(s.clearance);
    tf::placement_options options{
        .clearance = clearance, .precision = p.precision, .progress = progress};
    if (s.max_travel) options.max_travel = p.used(*s.max_travel);
    const tf::point3 direction = s.direction.value_or(tf::point3{0.0, 0.0, -1.0});
    switch (s.mode) {
        case place_mode::lay:
            return lay(p, progress);
        case place_mode::align:
            return align(p, progress);
        case place_mode::drop:
            if (s.has_bed()) options.bed = bed_of(s, p.precision, clearance);
            return tf::drop(mesh, fixed, options, direction);
        case place_mode::slide:
            return tf::slide(mesh, fixed, direction, options);
        case place_mode::turn:
            return turn(p, clearance, progress);
        case place_mode::mate:
            if (s.feature.kind) return mate(p, clearance, progress);
            return tf::mate(mesh, fixed, options);
        case place_mode::separate:
            return tf::separate(mesh, fixed, options);
        default:
            return tf::measure_in_place(mesh, fixed,
                                        {.clearance = clearance, .progress = progress});
    }
}

/// What else may be done.
std::string remedy_for(const tf::placement& at) {
    if (at.outcome == tf::placement_outcome::starts_penetrating)
        return "; tf-place separate moves it out";
    if (at.outcome == tf::placement_outcome::starts_below_bed)
        return "; with --fixed, drop only moves down: first drop it without --fixed";
    if (at.outcome == tf::placement_outcome::not_representable &&
        at.certificate.precision == tf::precision::float32)
        return "; --precision double, in a format that has it, may help";
    return {};
}

void find_place(job& work, placing& p) {
    const auto timing = work.time("search");
    try {
        p.at = search(p, work.progress("search"));
    } catch (const std::overflow_error&) {
        p.at = {.certificate = {.status = tf::status::out_of_range},
                .outcome = tf::placement_outcome::out_of_range};
    }
    work.call_ended();
    p.at.certificate.precision = p.precision;  // also of what was only measured
    if (p.at || !p.reason.empty()) return;
    p.reason = p.at.message(p.fixed.labels());
    p.remedy = remedy_for(p.at);
}

/// Of what has been looked at: the others are apart, whatever is inside.
void warn_of_inside_out(job& work, const placing& p) {
    const auto look_at = [&](const tf::body_set& set) {
        for (std::size_t i = 0; i < set.shapes.size(); ++i)
            if (set.shapes[i].indexes_built() > 0)
                warn_of_inside_out(work, set.shapes[i], set.label(i));
    };
    if (p.fixed.shapes.empty()) return;
    look_at(p.moving);
    look_at(p.fixed);
}

// ---- all on one plate ----

tf::body_set read_all(job& work, const place_settings& settings, const tf::transform<3>& start) {
    tf::body_set parts;
    std::uint64_t non_finite = 0;
    const auto counts = counts_of(settings.pack, work.options.inputs);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::string& path = work.options.inputs[i];
        json about{{"input", path}};
        tf::mesh_file file = work.read(path, about);
        work.warn(file.warnings, name_of_input(path) + ": ");
        const tf::body_file& added = add_moving(work, path, std::move(file), start, parts);
        if (added.cloud) refuse(added.label + ": a point cloud; pack takes meshes only");
        about["faces"] = added.content.stored_faces;
        non_finite += added.non_finite;
        for (std::uint64_t copy = 0; copy < counts[i]; ++copy) {
            if (copy > 0) parts.add(tf::mesh_file(added.content), added.label, added.name);
            work.entry["parts"].push_back(about);
        }
    }
    work.entry["skipped"]["non_finite"] = non_finite;
    return parts;
}

tf::packing find_places(job& work, const tf::body_set& parts, const place_settings& settings) {
    tf::pack_options options = pack_options_of(settings.pack);
    options.precision = precision_of(work, parts);
    options.corner.z = bed_of(settings, options.precision);
    options.progress = work.progress("search");
    const auto timing = work.time("search");
    tf::packing result = tf::pack(parts.shapes, options);
    work.call_ended();
    return result;
}

/// Enters and says what has a place.
void enter_places(job& work, const place_settings& settings, const tf::body_set& parts,
                  const tf::packing& found) {
    json& entry = work.entry;
    const std::uint64_t count = parts.files.size();
    std::string words = found.message();
    for (const std::uint32_t i : found.not_placed) {
        words += (entry["not_placed"].empty() ? "; not placed: " : ", ") + parts.files[i].label;
        entry["not_placed"].push_back(entry["parts"][i]["input"]);
    }
    entry.update(packing_entry(found));
    entry["fits"] = entry["placed"] = found.not_placed.empty();
    entry["bed"] = {{"given", settings.bed.value_or(0.0)}, {"used", found.bed}, {"reached", true}};
    const std::uint64_t pairs = count * (count - 1) / 2;
    entry["skipped"]["pairs_culled_by_box"] =
        pairs - std::min<std::uint64_t>(pairs, found.pairs_measured);
    work.out.result(work.name + ": " + words);
}

}  // namespace

exit_status place_one(job& work, const place_settings& settings, fixed_meshes& fixed) {
    const tf::transform<3> start = read_matrix(settings.start);
    placing p{.settings = settings, .fixed = fixed.bodies};
    const tf::body_file& file = add_moving(work, work.path, work.read(), start, p.moving);
    p.precision = precision_of(work, p.moving);
    read_fixed(work, settings, settings.scene && p.precision == tf::precision::float32, fixed);
    enter_inputs(work.entry, file, fixed);
    find_place(work, p);
    if (settings.mode != place_mode::align) warn_of_inside_out(work, p);
    p.matrix = p.at.matrix.after(start);
    enter_place(work.entry, p);
    say_place(work, p);
    if (!p.at) {
        write_page(work, p);
        return found;
    }
    exit_status status = p.aligned && !p.aligned->converged ? found : done;
    std::optional<tf::deviation_result> distances;
    if (settings.mode == place_mode::measure)
        status = enter_measured(work, settings.deviation, p.moving, p.fixed, p.at, distances);
    write_page(work, p, distances ? &*distances : nullptr);
    const auto timing = work.time("write");
    write_matrix(work, settings.matrix, matrix_text(p.matrix));
    write_result(work, settings, p.moving, {{0, p.at.points, p.at.matrix, p.matrix}}, p.fixed,
                 p.at);
    return status;
}

exit_status pack_all(job& work, const place_settings& settings) {
    const tf::transform<3> start = read_matrix(settings.start);
    tf::body_set parts = read_all(work, settings, start);
    const tf::packing plate = find_places(work, parts, settings);
    enter_places(work, settings, parts, plate);
    write_page(work, settings, parts, plate);
    std::vector<placed_body> placed;
    std::string matrix_lines;
    for (std::size_t i = 0; i < parts.shapes.size(); ++i) {
        const tf::packed_part& at = plate.parts[i];
        const tf::transform<3> matrix = at.matrix.after(start);
        matrix_lines += matrix_text(matrix);
        work.entry["parts"][i].update({{"placed", at.placed},
                                       {"plate", or_null(at.placed, at.plate)},
                                       {"matrix", or_null(at.placed, matrix)}});
        if (at.placed) placed.push_back({i, at.points, at.matrix, matrix});
    }
    const auto timing = work.time("write");
    write_matrix(work, settings.matrix, matrix_lines);
    write_result(work, settings, parts, placed, {}, {.certificate = plate.certificate});
    return plate.not_placed.empty() ? done : found;
}

}  // namespace tools
