#include "tools/page/page.hpp"

#include "tools/common/console.hpp"
#include "tools/common/output_file.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/mesh/curves.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <algorithm>
#include <set>

namespace tools {
namespace {

constexpr std::size_t most_regions = 1000;

std::vector<face_kind> kinds_of(const findings& result) {
    const std::uint64_t others = result.searched - result.marks.marked();
    std::vector<face_kind> kinds{{"other", tf::mark_colors[0], others}};
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k)
        kinds.push_back({name_of(static_cast<tf::pair_kind>(k)), tf::mark_colors[k + 1], 0});
    for (const tf::face_pair& pair : result.found.pairs)
        ++kinds[static_cast<std::size_t>(pair.kind) + 1].count;
    return kinds;
}

packed_scene scene_of(const findings& result) {
    std::vector<std::uint32_t> numbers(result.part.mesh.faces.size());
    for (std::uint32_t f = 0; f < numbers.size(); ++f) numbers[f] = result.part.face_in_file(f);
    const auto curves = tf::intersection_curves(result.part.mesh, result.found.pairs);
    return pack({.mesh = result.part.mesh,
                 .kind = result.marks.kind,
                 .region = result.marks.region,
                 .number = std::move(numbers),
                 .curves = curves});
}

void append(std::string& list, const std::string& word) {
    list += (list.empty() ? "" : ", ") + word;
}

std::vector<place_row> rows_of(const findings& result) {
    const std::size_t count = std::min(result.regions.regions.size(), most_regions);
    std::vector<std::set<std::string>> kinds(count);
    for (std::size_t i = 0; i < result.found.pairs.size(); ++i)
        if (const std::uint32_t r = result.regions.region_of_pair[i]; r < count)
            kinds[r].insert(name_of(result.found.pairs[i].kind));
    std::vector<place_row> rows;
    for (std::size_t id = 0; id < count; ++id) {
        const tf::intersection_region& region = result.regions.regions[id];
        std::string kinds_text, components;
        for (const std::string& kind : kinds[id]) append(kinds_text, kind);
        for (const std::uint32_t c : result.components_of(region))
            append(components, std::to_string(c));
        rows.push_back({.cells = {{std::to_string(id), true},
                                  {kinds_text},
                                  {grouped(region.pairs), true},
                                  {grouped(region.faces.size()), true},
                                  {in_words(region.center())},
                                  {in_words(region.min) + " to " + in_words(region.max)},
                                  {components}},
                        .low = region.min,
                        .high = region.max});
    }
    return rows;
}

std::vector<std::pair<std::string, std::string>> facts_of(const job& work, const findings& result,
                                                          const search_settings& settings) {
    const auto text_of = [&](const char* key) {
        const auto at = work.entry.find(key);
        return at != work.entry.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    const auto degenerate = static_cast<std::size_t>(tf::pair_kind::degenerate);
    return {{"file", work.name + ", " + text_of("format")},
            {"sha256", text_of("sha256")},
            {"coordinates", text_of("precision_in") + ", unit " + work.options.unit},
            {"faces", grouped(result.faces_stored) + " stored, " + grouped(result.triangles) +
                          " triangles, " + grouped(result.searched) + " searched"},
            {"vertices", grouped(result.points_stored) + " stored, " +
                             grouped(result.part.distinct.value_or(0)) + " distinct"},
            {"box", in_words(result.box->min) + " to " + in_words(result.box->max)},
            {"left out", counted(result.part.dropped, "face", "faces") + " not finite"},
            {"degenerate", counted(result.part.degenerate, "face", "faces") + ", " +
                               counted(result.found.counts[degenerate], "pair", "pairs")},
            {"tolerance",
             settings.tolerance.given + " (" + brief(result.tolerance_used) + " in file units)"},
            {"program", std::string("tf-selfintersect ") + tf::version_string()}};
}

}  // namespace

void write_page(const job& work, const findings& result, const search_settings& settings) {
    if (work.options.html.empty()) return;
    page contents;
    contents.title = work.name;
    contents.verdict = verdict(result, settings);
    contents.good = result.found.pairs.empty();
    contents.kinds = kinds_of(result);
    contents.scene = scene_of(result);
    const std::string format = work.entry.value("format", std::string());
    contents.y_is_up = format.starts_with("obj") || format.starts_with("gl");
    contents.place_columns = {"region", "kinds", "pairs", "faces", "center", "box", "components"};
    contents.places = rows_of(result);
    if (result.regions.regions.size() > most_regions)
        contents.places_note = "The first " + grouped(most_regions) + " of " +
                               grouped(result.regions.regions.size()) +
                               "; the JSON report (-r) lists all.";
    contents.facts = facts_of(work, result, settings);
    write_file(work.options.html, work.options.force, work.keeper,
               [&](output_file& file) { file.write(html(contents)); });
}

}  // namespace tools
