#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/mesh/intersections.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace tools {
namespace {

constexpr std::size_t most_regions = 1000;
constexpr std::uint8_t curve_class = 1 + tf::pair_kind_count;

using segment_lists = tf::answer_lists<std::array<tf::point3, 2>>;

std::vector<scene_class> classes_of(const findings& result) {
    const std::uint64_t others = result.searched - result.marks.marked();
    std::vector<scene_class> classes{
        {"other", tf::mark_colors[0], counted(others, "face", "faces"), true}};
    std::array<std::uint64_t, tf::pair_kind_count> counts{};
    for (const tf::face_pair& pair : result.found.pairs)
        ++counts[static_cast<std::size_t>(pair.kind)];
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k)
        classes.push_back({tf::name_of(static_cast<tf::pair_kind>(k)), tf::mark_colors[k + 1],
                           counted(counts[k], "pair", "pairs")});
    classes.push_back({"curves", "#10131a"});
    return classes;
}

void add_mesh(scene& shown, const findings& result, const segment_lists& segments) {
    scene_mesh mesh{.mesh = result.part.mesh, .kind = result.marks.kind, .group_word = "region"};
    for (std::uint32_t f = 0; f < result.part.mesh.faces.size(); ++f)
        mesh.number.push_back(result.part.face_in_file(f));
    mesh.group.assign(result.marks.region.begin(), result.marks.region.end());
    shown.meshes.push_back(std::move(mesh));
    scene_lines curves{.kind = curve_class, .ends = segments.answers};
    shown.lines.push_back(std::move(curves));
}

/// [R] The boxes of curves: where long faces meet, rather than where they are.
std::vector<tf::box3> places_of(const findings& result, const segment_lists& segments) {
    std::vector<std::optional<tf::box3>> boxes(result.regions.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        auto& box = boxes[result.region_of(result.found.pairs[i])];
        for (const auto& ends : segments[i])
            for (const tf::point3& p : ends) {
                if (!box) box = {p, p};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    box->min[axis] = std::min(box->min[axis], p[axis]);
                    box->max[axis] = std::max(box->max[axis], p[axis]);
                }
            }
    }
    std::vector<tf::box3> places;
    for (std::size_t r = 0; r < boxes.size(); ++r) {
        const tf::intersection_region& region = result.regions[r];
        places.push_back(boxes[r].value_or(tf::box3{region.min, region.max}));
    }
    return places;
}

void append(std::string& list, const std::string& word) {
    list += (list.empty() ? "" : ", ") + word;
}

scene_table regions_of(const findings& result, const std::vector<tf::box3>& places) {
    const std::size_t count = std::min(result.regions.size(), most_regions);
    std::vector<std::set<std::string>> kinds(count);
    for (std::size_t r = 0; r < count; ++r)
        for (const std::uint32_t i : result.regions[r].pairs)
            kinds[r].insert(tf::name_of(result.found.pairs[i].kind));
    scene_table table{
        .title = "Regions",
        .columns = {"region", "kinds", "pairs", "faces", "center", "box", "components"}};
    for (std::size_t id = 0; id < count; ++id) {
        const tf::intersection_region& region = result.regions[id];
        std::string kinds_text, components;
        for (const std::string& kind : kinds[id]) append(kinds_text, kind);
        for (const std::uint32_t c : result.components_of(region))
            append(components, std::to_string(c));
        table.rows.push_back(
            {.cells = {id, kinds_text, region.pairs.size(), region.faces.size(),
                       in_words(region.center()),
                       in_words(region.min) + " to " + in_words(region.max), components},
             .box = places[id]});
    }
    if (result.regions.size() > most_regions)
        table.note = "The first " + grouped(most_regions) + " of " +
                     grouped(result.regions.size()) + "; the JSON report (-r) lists all.";
    return table;
}

void add_facts(scene& shown, const findings& result, const search_settings& settings) {
    const auto degenerate = static_cast<std::size_t>(tf::pair_kind::degenerate);
    shown.facts.insert(
        shown.facts.end() - 1,
        {{"faces", grouped(result.faces_stored) + " stored, " + grouped(result.triangles) +
                       " triangles, " + grouped(result.searched) + " searched"},
         {"vertices", grouped(result.points_stored) + " stored, " +
                          grouped(result.part.distinct.value_or(0)) + " distinct"},
         {"box", in_words(result.box->min) + " to " + in_words(result.box->max)},
         {"left out", counted(result.part.non_finite, "face", "faces") + " not finite"},
         {"degenerate", counted(result.part.degenerate, "face", "faces") + ", " +
                            counted(result.found.counts[degenerate], "pair", "pairs")},
         {"tolerance",
          settings.tolerance.given + " (" + brief(result.tolerance_used) + " in file units)"}});
}

}  // namespace

void write_page(job& work, const findings& result, const search_settings& settings) {
    if (!work.options.shows()) return;
    scene shown = scene_of(work, "tf-selfintersect");
    shown.verdict = verdict(result, settings);
    shown.good = result.found.pairs.empty();
    shown.place_word = "region";
    shown.classes = classes_of(result);
    const auto segments = tf::intersection_curves(result.part.mesh, result.found.pairs);
    add_mesh(shown, result, segments);
    if (!result.regions.empty())
        shown.tables.push_back(regions_of(result, places_of(result, segments)));
    add_facts(shown, result, settings);
    write_page(work, std::move(shown));
}

}  // namespace tools
