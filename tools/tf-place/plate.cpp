#include "tools/tf-place/plate.hpp"

#include "tools/common/console.hpp"
#include "tools/common/output_file.hpp"
#include "tools/tf-place/move.hpp"
#include "tools/tf-place/outputs.hpp"
#include "tools/tf-place/rounding.hpp"
#include <treeform/mesh/arrange.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace tools {
namespace {

std::vector<body> read_all(job& work, const tf::transform<3>& start) {
    std::vector<body> bodies;
    std::uint64_t non_finite = 0;
    for (const std::string& path : work.options.inputs) {
        json about{{"input", path}};
        tf::mesh_file file = work.read(path, about);
        for (const tf::io_warning& w : file.warnings)
            work.warn(w.code, name_of_input(path) + ": " + w.text);
        if (start != tf::transform<3>{})
            for (tf::point3& p : file.mesh.points) p = start(p);
        bodies.push_back(make_body(work, path, std::move(file)));
        if (bodies.back().cloud)
            throw failure(
                bad_usage, "usage",
                bodies.back().label() + ": is a cloud of points; arrange takes meshes only");
        about["faces"] = bodies.back().file->stored_faces;
        non_finite += bodies.back().non_finite;
        work.entry["parts"].push_back(std::move(about));
    }
    work.entry["skipped"]["non_finite"] = non_finite;
    return bodies;
}

json rows_of(const tf::transform<3>& matrix) {
    json rows = json::array();
    for (const auto& row : matrix.rows) rows.push_back(row);
    rows.push_back({0.0, 0.0, 0.0, 1.0});
    return rows;
}

void enter_places(job& work, const std::vector<body>& bodies, const tf::arrangement& found,
                  const std::vector<tf::transform<3>>& matrices) {
    json& entry = work.entry;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        entry["parts"][i]["placed"] = found.parts[i].placed;
        entry["parts"][i]["matrix"] = found.parts[i].placed ? rows_of(matrices[i]) : json(nullptr);
    }
    for (const std::uint32_t i : found.not_placed) entry["not_placed"].push_back(bodies[i].path);
    entry["fits"] = found.not_placed.empty();
    entry["placed"] = found.not_placed.empty();
    const std::uint64_t pairs = bodies.size() * (bodies.size() - 1) / 2;
    entry["skipped"]["pairs_culled_by_box"] =
        pairs - std::min<std::uint64_t>(pairs, found.pairs_measured);
}

}  // namespace

exit_status arrange_all(job& work, const place_settings& settings) {
    enter_blank_report(work, settings);
    check_outputs(work, settings);
    const tf::transform<3> start =
        settings.start.empty() ? tf::transform<3>{} : read_matrix(settings.start);
    std::vector<body> bodies = read_all(work, start);
    const bool to_single = std::all_of(bodies.begin(), bodies.end(),
                                       [&](const body& b) { return writes_single(work, *b.file); });
    tf::arrange_options options = settings.arrange;
    const double bed = settings.bed.value_or(0.0);
    options.corner.z = bed_to_write(bed, to_single);
    options.to_single = to_single;
    std::vector<tf::mesh_view> views;
    for (const body& b : bodies) views.push_back(b.mesh);
    options.progress = work.progress("search");
    tf::arrangement found;
    {
        const auto timing = work.time("search");
        found = tf::arrange(views, options);
    }
    work.out.end_progress();
    work.keeper.check();

    std::vector<tf::transform<3>> matrices;
    std::vector<bool> placed;
    std::vector<rounding> roundings;
    std::string matrix_lines;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        matrices.push_back(tf::after(found.parts[i].matrix, start));
        placed.push_back(found.parts[i].placed);
        if (placed[i]) {
            const tf::arranged_part& at = found.parts[i];
            if (wants_mesh(work.options))
                roundings.push_back(
                    look_at_rounding(work, bodies[i], at.matrix, at.points, to_single));
            take_places(bodies[i], at.points, at.matrix, to_single);
            tf::transform_normals(*bodies[i].file, matrices[i]);
        }
        matrix_lines += matrix_text(matrices[i]);
    }
    enter_places(work, bodies, found, matrices);
    work.entry["bed"] = {{"given", bed}, {"used", options.corner.z}, {"reached", true}};
    std::string words = std::to_string(bodies.size() - found.not_placed.size()) + " of " +
                        counted(bodies.size(), "part", "parts") + " placed";
    for (const std::uint32_t i : found.not_placed) words += "; no place for " + bodies[i].label();
    work.out.result(work.name + ": " + words);
    if (!roundings.empty()) enter_rounding(work, roundings, to_single);
    const auto timing = work.time("write");
    if (!settings.matrix.empty()) {
        output_file file(settings.matrix, work.options.force, work.keeper);
        file.write(matrix_lines);
        file.commit();
    }
    write_plate(work, bodies, placed, to_single);
    return found.not_placed.empty() ? done : tools::found;
}

}  // namespace tools
