#include "tools/common/console.hpp"
#include "tools/common/matrix_file.hpp"
#include "tools/common/mesh_output.hpp"
#include "tools/tf-place/outcome.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <vector>

namespace tools {
namespace {

body_set read_all(job& work, const tf::transform<3>& start) {
    body_set parts;
    std::uint64_t non_finite = 0;
    for (const std::string& path : work.options.inputs) {
        json about = read_body(work, path, start, parts);
        const body& one = parts.bodies.back();
        if (one.cloud) refuse(one.label() + ": is a cloud of points; arrange takes meshes only");
        about["faces"] = one.file->stored_faces;
        non_finite += one.non_finite;
        work.entry["parts"].push_back(std::move(about));
    }
    work.entry["skipped"]["non_finite"] = non_finite;
    return parts;
}

void enter_places(job& work, const body_set& parts, const tf::packing& found,
                  const std::vector<tf::transform<3>>& matrices) {
    json& entry = work.entry;
    const std::uint64_t count = parts.bodies.size();
    for (std::size_t i = 0; i < count; ++i) {
        entry["parts"][i]["placed"] = found.parts[i].placed;
        entry["parts"][i]["matrix"] = or_null(found.parts[i].placed, rows_of(matrices[i]));
    }
    for (const std::uint32_t i : found.not_placed)
        entry["not_placed"].push_back(parts.bodies[i].path);
    entry["fits"] = found.not_placed.empty();
    entry["placed"] = found.not_placed.empty();
    const std::uint64_t pairs = count * (count - 1) / 2;
    entry["skipped"]["pairs_culled_by_box"] =
        pairs - std::min<std::uint64_t>(pairs, found.pairs_measured);
}

tf::packing find_places(job& work, const body_set& parts, const place_settings& settings,
                        tf::precision precision) {
    tf::pack_options options = settings.arrange;
    options.corner.z = settings.bed.value_or(0.0);
    check_bed(options.corner.z, precision);
    options.precision = precision;
    options.progress = work.progress("search");
    const auto timing = work.time("search");
    tf::packing found = tf::pack(parts.shapes, options);
    work.call_ended();
    return found;
}

}  // namespace

exit_status arrange_all(job& work, const place_settings& settings) {
    enter_blank_report(work, settings);
    check_outputs(work, {settings.matrix});
    const tf::transform<3> start = start_of(settings);
    body_set parts = read_all(work, start);
    const bool all_single = std::all_of(
        parts.bodies.begin(), parts.bodies.end(),
        [&](const body& b) { return precision_of(work, *b.file) == tf::precision::float32; });
    const auto precision = all_single ? tf::precision::float32 : tf::precision::float64;
    const tf::packing found = find_places(work, parts, settings, precision);

    std::vector<tf::transform<3>> matrices;
    std::vector<placed_body> placed;
    std::vector<const body*> there;
    std::string matrix_lines;
    for (std::size_t i = 0; i < parts.bodies.size(); ++i) {
        const tf::packed_part& at = found.parts[i];
        matrices.push_back(tf::after(at.matrix, start));
        matrix_lines += matrix_text(matrices[i]);
        if (!at.placed) continue;
        placed.push_back({i, at.points, at.matrix, matrices[i]});
        there.push_back(&parts.bodies[i]);
    }
    enter_places(work, parts, found, matrices);
    work.entry["bed"] = {
        {"given", settings.bed.value_or(0.0)}, {"used", found.bed}, {"reached", true}};
    std::string words = std::to_string(there.size()) + " of " +
                        counted(parts.bodies.size(), "part", "parts") + " placed";
    for (const std::uint32_t i : found.not_placed)
        words += "; no place for " + parts.bodies[i].label();
    work.out.result(work.name + ": " + words);
    const auto path = mesh_output(work.options, work.path);
    if (path) enter_rounding(work, parts, placed, precision);
    const auto timing = work.time("write");
    write_matrix(work, settings, matrix_lines);
    if (path && !work.options.dry_run && !there.empty()) {
        put_back(parts, placed, precision);
        const written_form form = form_of(work, *there[0]->file, *path);
        write(work, scene_of(work, there, form.format), form, *path, precision, true);
    }
    return found.not_placed.empty() ? done : tools::found;
}

}  // namespace tools
