#include "tools/tf-place/assembly/measured.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/made/report_fields.hpp"
#include "tools/shell/output_file.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/tf-place/assembly/contact_entries.hpp"
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace tools {
namespace {

void enter_depth(job& work, const tf::body_set& moving, const tf::body_set& fixed,
                 const tf::placement& at) {
    if (at.relation != tf::mesh_relation::penetrating || !at.nearest) return;
    const std::size_t other = at.nearest_fixed;
    const auto timing = work.time("search");
    const auto found = tf::penetration_depth(moving.shapes[0], fixed.shapes[other],
                                             {.progress = work.progress("depth")});
    work.call_ended(found && found->status == tf::status::cancelled);
    if (!found || found->status != tf::status::ok) return;
    work.entry["depth"] = {
        {"bound", found->depth}, {"move", found->move}, {"effort", effort_entry(found->effort)}};
    work.out.result(work.name + ": at most " + brief(found->depth) + " deep: a translation by " +
                    in_words(found->move) + " moves it out of " + fixed.label(other) +
                    skipped_in_words(found->effort));
}

/// `known` of all points, if it is.
void enter_points(job& work, const tf::body_set& moving, const tf::body_set& fixed,
                  const std::optional<std::array<std::uint64_t, 3>>& known) {
    if (!moving.file_of(0).cloud) return;
    const tf::points_view points = moving.shapes[0].indexed_view().points;
    const auto [inside, on, outside] = known ? *known : tf::count_sides(points, fixed.shapes);
    work.call_ended();
    work.entry["points"] = {{"inside", inside}, {"on", on}, {"outside", outside}};
    work.out.result(work.name + ": " + grouped(inside) + " of " +
                    counted(points.size(), "point", "points") + " inside, " + grouped(on) +
                    " on the surface");
}

json deviation_entry(const tf::deviation_result& r, const deviation_settings& settings) {
    json band = nullptr;
    if (settings.band) {
        band = {{"low", (*settings.band)[0]}, {"high", (*settings.band)[1]}};
        const auto& [below, within, above] = *r.band_counts;
        band.update({{"below", below}, {"within", within}, {"above", above}});
    }
    json entry = {{"signed", r.is_signed}, {"points", r.distances.size()}};
    entry.update(deviations_entry(r));
    entry.update(
        {{"hausdorff",
          {{"forward", {{"sampled", r.max}, {"bound", r.max_bound}}},
           {"backward", r.reverse_max
                            ? json{{"sampled", *r.reverse_max}, {"bound", *r.reverse_max_bound}}
                            : json(nullptr)}}},
         {"histogram", {{"low", r.lowest}, {"high", r.highest}, {"counts", r.histogram}}},
         {"tolerance_band", band},
         {"distances_file", or_null(!settings.distances.empty(), settings.distances.string())},
         {"color_scale", nullptr}});
    return entry;
}

/// The whole band, or what 99 % of the points are within, to the same length both ways.
double scale_of(const tf::deviation_result& r, const deviation_settings& settings) {
    if (!settings.band) return r.p99 > 0.0 ? r.p99 : r.max;
    return std::max(std::abs((*settings.band)[0]), std::abs((*settings.band)[1]));
}

void write_distances(job& work, const deviation_settings& settings, const tf::body_set& moving,
                     const tf::deviation_result& r) {
    const double scale = scale_of(r, settings);
    work.entry["deviation"]["color_scale"] = {{"low", r.is_signed ? -scale : 0.0}, {"high", scale}};
    if (settings.distances.empty() || work.options.dry_run) return;
    const auto timing = work.time("write");
    tf::mesh_file file = moving.files[0].content;
    tf::deviation_result::color(file, moving.distances_in_file(0, r.distances), -scale, scale);
    output_place place(settings.distances, work.options.force);
    tf::write(place.writable(), file, {.format = "ply"});
    place.commit();
}

std::string sentence(const tf::deviation_result& r, const deviation_settings& settings) {
    const std::string text = std::string(r.is_signed ? "signed" : "unsigned") + " distances of " +
                             counted(r.distances.size(), "point", "points") + ": mean " +
                             brief(r.mean) + ", rms " + brief(r.rms) + ", 95% within " +
                             brief(r.p95) + ", from " + brief(r.lowest) + " to " + brief(r.highest);
    return text + band_in_words(r, settings);
}

}  // namespace

std::uint64_t out_of_band(const tf::deviation_result& r) {
    return r.band_counts ? r.band_counts->front() + r.band_counts->back() : 0;
}

std::string band_in_words(const tf::deviation_result& r, const deviation_settings& settings) {
    if (!r.band_counts) return {};
    const std::uint64_t out = out_of_band(r);
    return "; " +
           (out == 0 ? "all within" : grouped(out) + (out == 1 ? " is" : " are") + " out of") +
           " the band from " + shortest((*settings.band)[0]) + " to " +
           shortest((*settings.band)[1]);
}

void warn_of_inside_out(job& work, const tf::prepared_mesh& body, const std::string& name) {
    const std::uint64_t count = tf::count_inside_out(body);
    if (count == 0) return;
    const auto [points, faces] = body.indexed_view();
    const auto components = tf::count_topology(points.size(), faces).components_by_edge;
    work.warn(
        "inside-out",
        name + ": " +
            (components == 1 ? "is inside out"
                             : grouped(count) + " of " + grouped(components) + " components " +
                                   (count == 1 ? "is" : "are") + " inside out") +
            ": faces point inward; used as the solid that they bound");
}

void add_deviation_options(command_line& line, deviation_settings& settings) {
    line.output(settings.distances, {"--distances", "FILE",
                                     "measure: MOVING as a PLY with the signed distance\n"
                                     "of each point from --fixed, negative inside, and\n"
                                     "colors from blue (inside) to red"});
    line.option({"--tolerance-band", "LO,HI",
                 "measure: exit 1 if a point's signed distance is\n"
                 "less than LO or more than HI"},
                [&settings](std::string_view text) {
                    const auto v = parse_numbers("--tolerance-band", text, 2);
                    if (!(v[0] <= v[1]))
                        refuse("--tolerance-band " + std::string(text) + ": LO is more than HI");
                    settings.band = {v[0], v[1]};
                });
    line.flag(settings.no_depth,
              {"--no-depth", "", "measure: skip the depth, which takes longest"});
}

exit_status enter_measured(job& work, const deviation_settings& settings,
                           const tf::body_set& moving, const tf::body_set& fixed,
                           const tf::placement& at, std::optional<tf::deviation_result>& found) {
    if (settings.wanted()) {
        const auto timing = work.time("search");
        found = tf::deviation(moving.shapes[0], fixed.shapes,
                              {.band = settings.band, .progress = work.progress("distances")});
    }
    work.call_ended(found && found->status == tf::status::cancelled);
    // Several solids count one by one, their distances as one surface.
    const bool same = found && fixed.shapes.size() == 1;
    enter_points(work, moving, fixed, same ? found->side_counts : std::nullopt);
    if (!settings.no_depth) enter_depth(work, moving, fixed, at);
    if (!found) return done;
    if (!found->is_signed)
        work.warn("unsigned", "--fixed is open or a cloud: distances have no sign");
    work.entry["deviation"] = deviation_entry(*found, settings);
    write_distances(work, settings, moving, *found);
    work.out.result(work.name + ": " + sentence(*found, settings));
    const bool out = out_of_band(*found) > 0;
    return out ? tools::found : done;
}

}  // namespace tools
