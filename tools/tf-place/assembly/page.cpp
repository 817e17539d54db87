#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-place/assembly/assembly.hpp"
#include <treeform/mesh/as_mesh.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

constexpr std::size_t most_colors = 200;  // pairs beyond share the last
constexpr std::size_t most_rows = 1000;
constexpr std::uint8_t parts_class = 0;

std::uint8_t class_of_pair(std::size_t rank) {
    return static_cast<std::uint8_t>(1 + std::min(rank, most_colors - 1));
}

/// All that a pair has in common, or the way between its parts.
std::optional<tf::box3> box_of_pair(const tf::part_clash& one) {
    std::vector<tf::point3> ends;
    for (const tf::contact_region& region : one.regions)
        ends.insert(ends.end(), {region.box.min, region.box.max});
    if (one.nearest) ends.insert(ends.end(), one.nearest->begin(), one.nearest->end());
    return tf::bounding_box(ends);
}

/// A color for each pair.
void add_classes(scene& shown, const named_assembly& all,
                 const std::vector<const tf::part_clash*>& pairs) {
    shown.classes = {{"parts", "#c9ced6", counted(all.names.size(), "part", "parts"), true}};
    for (std::size_t i = 0; i < std::min(pairs.size(), most_colors); ++i) {
        const tf::part_clash& one = *pairs[i];
        const bool last = i + 1 == most_colors && pairs.size() > most_colors;
        shown.classes.push_back(
            {last ? "other pairs"
                  : all.names[one.a] + " and " + all.names[one.b] + ", " + name_of(one.relation),
             scene_color(i),
             last || one.face_pairs == 0
                 ? ""
                 : counted(one.face_pairs, "pair of faces", "pairs of faces")});
    }
}

/// Each face in the color of the gravest pair that it is in.
void add_parts(scene& shown, const named_assembly& all,
               const std::vector<const tf::part_clash*>& pairs) {
    for (std::size_t i = 0; i < all.names.size(); ++i) {
        const tf::mesh_view part = all.set.shapes[i].indexed_view();
        scene_mesh mesh{.mesh = part,
                        .kind = std::vector<std::uint8_t>(part.faces.size(), parts_class),
                        .name = all.names[i]};
        for (std::uint32_t f = 0; f < part.faces.size(); ++f)
            mesh.number.push_back(all.set.face_in_file(i, f));
        shown.meshes.push_back(std::move(mesh));
    }
    for (std::size_t rank = pairs.size(); rank-- > 0;)
        for (const tf::contact_region& region : pairs[rank]->regions) {
            for (const std::uint32_t f : region.faces_a)
                shown.meshes[pairs[rank]->a].kind[f] = class_of_pair(rank);
            for (const std::uint32_t f : region.faces_b)
                shown.meshes[pairs[rank]->b].kind[f] = class_of_pair(rank);
        }
}

void add_ways(scene& shown, const std::vector<const tf::part_clash*>& pairs) {
    for (std::size_t rank = 0; rank < pairs.size(); ++rank)
        if (const auto& nearest = pairs[rank]->nearest)
            shown.lines.push_back({.kind = class_of_pair(rank),
                                   .ends = {*nearest},
                                   .word = "nearest points",
                                   .labeled = "length",
                                   .text = brief(pairs[rank]->distance) +
                                           (shown.unit.empty() ? "" : " " + shown.unit),
                                   .width = 3.0});
}

scene_table table_of(const named_assembly& all, const std::vector<const tf::part_clash*>& pairs) {
    scene_table table{.title = "Pairs",
                      .columns = {"part", "other part", "relation", "distance", "depth at most",
                                  "common volume", "regions", "pairs of faces"}};
    const auto or_blank = [](const std::optional<double>& value) {
        return value ? json(*value) : json("");
    };
    for (std::size_t i = 0; i < std::min(pairs.size(), most_rows); ++i) {
        const tf::part_clash& one = *pairs[i];
        table.rows.push_back({.cells = {all.names[one.a], all.names[one.b], name_of(one.relation),
                                        one.distance, or_blank(one.depth), or_blank(one.volume),
                                        one.regions.size(), one.face_pairs},
                              .box = box_of_pair(one)});
    }
    if (pairs.size() > most_rows)
        table.note = "The first " + grouped(most_rows) + " of " + grouped(pairs.size()) +
                     "; the JSON report (-r) lists all.";
    return table;
}

}  // namespace

void write_page(job& work, const named_assembly& all, const tf::clash_result& r,
                const std::string& verdict) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-place");
    shown.title = work.name + ": clash";
    shown.verdict = verdict;
    shown.good = r.clashes == 0;
    shown.place_word = "pair";
    const std::vector<const tf::part_clash*> pairs = gravest_first(r);
    add_classes(shown, all, pairs);
    add_parts(shown, all, pairs);
    add_ways(shown, pairs);
    if (!pairs.empty()) shown.tables.push_back(table_of(all, pairs));
    write_page(work, std::move(shown));
}

}  // namespace tools
