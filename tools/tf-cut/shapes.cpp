#include "tools/shell/console.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/simplify.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

json distances_entry(const cut_settings& s, double used, double resolution, double least,
                     double greatest) {
    return {{"given", s.shape.distance.given},
            {"used", used},
            {"resolution", or_null(resolution > 0.0, resolution)},
            {"min", least},
            {"max", greatest}};
}

/// Enters what cavities have no way out, and says which drains lead nowhere.
void say_drains(job& work, const cut_settings& s, const tf::offset_result& made) {
    work.entry["cavities"] = {{"sealed", made.sealed_cavities},
                              {"blind_drains", made.blind_drains}};
    for (const std::uint32_t i : made.blind_drains)
        work.warn("blind-drain", "the drain at " + in_words(s.shape.drains[i].first) +
                                     " may not lead from outside into a cavity");
    if (!s.shape.drains.empty() && made.sealed_cavities > 0)
        work.warn("sealed",
                  counted(made.sealed_cavities, "cavity has", "cavities have") + " no drain");
}

}  // namespace

cut_off shape_of(job& work, const cut_settings& s, const usable_input& input,
                 tf::precision precision) {
    const auto timing = work.time("cut");
    const tf::mesh& mesh = input.file.mesh;
    const double distance = s.shape.distance.used(diagonal_of(input));
    if (s.mode == cut_mode::simplify) {
        const std::vector<std::uint32_t> groups =
            tf::attribute_sources(input.source()).corner_groups();
        tf::simplify_result made = tf::simplify(mesh, distance,
                                                {.precision = precision,
                                                 .target_faces = s.shape.fewest_faces,
                                                 .corner_groups = groups,
                                                 .progress = work.progress("simplify")});
        work.call_ended(made.certificate.status == tf::status::cancelled);
        work.entry["distances"] =
            distances_entry(s, distance, 0.0, 0.0,
                            std::max(made.input_to_result_bound, made.result_to_input_bound));
        cut_off piece = cut_off_of(std::move(made.mesh), std::move(made.face_source),
                                   std::move(made.vertex_source), std::move(made.certificate));
        piece.face_of_new_vertex = std::move(made.face_of_new_vertex);
        piece.corner_source = std::move(made.corner_source);
        return piece;
    }
    const tf::offset_options options{.resolution = s.shape.resolution,
                                     .shift = s.shape.shift * distance,
                                     .drains = s.shape.drains,
                                     .precision = precision,
                                     .progress = work.progress(s.mode_text)};
    tf::offset_result made = s.mode == cut_mode::offset   ? tf::offset(mesh, distance, options)
                             : s.mode == cut_mode::hollow ? tf::hollow(mesh, distance, options)
                                                          : tf::thicken(mesh, distance, options);
    work.call_ended(made.certificate.status == tf::status::cancelled);
    work.entry["distances"] =
        distances_entry(s, distance, made.resolution, made.least_distance, made.greatest_distance);
    if (s.mode == cut_mode::hollow && made.certificate) say_drains(work, s, made);
    return cut_off_of(std::move(made.mesh), {}, {}, std::move(made.certificate));
}

}  // namespace tools
