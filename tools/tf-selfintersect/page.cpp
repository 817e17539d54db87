#include "tools/tf-selfintersect/page.hpp"

#include "tools/common/console.hpp"
#include "tools/common/page/page.hpp"
#include "tools/tf-selfintersect/marks.hpp"
#include "tools/tf-selfintersect/words.hpp"
#include <treeform/mesh/curves.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <algorithm>
#include <charconv>
#include <set>

namespace tools {
namespace {

constexpr std::size_t most_regions = 1000;

std::vector<face_kind> kinds_of(const findings& result) {
    std::vector<face_kind> kinds{{"other faces", mark_colors[0], 0}};
    kinds[0].count = result.mesh.faces.size() - result.faces_hit().size();
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k)
        kinds.push_back({name_of(static_cast<tf::pair_kind>(k)), mark_colors[k + 1], 0});
    for (const tf::face_pair& pair : result.found.pairs)
        ++kinds[static_cast<std::size_t>(pair.kind) + 1].count;
    return kinds;
}

packed_scene scene_of(const findings& result) {
    const face_marks marks = mark_faces(result);
    std::vector<std::uint32_t> regions(marks.region.size());
    for (std::size_t f = 0; f < regions.size(); ++f)
        regions[f] = static_cast<std::uint32_t>(std::max(marks.region[f], 0));
    std::vector<std::uint32_t> numbers(result.mesh.faces.size());
    for (std::uint32_t f = 0; f < numbers.size(); ++f) numbers[f] = result.stored_face(f);
    const auto curves = tf::intersection_curves(result.mesh, result.found.pairs);
    return pack({.mesh = result.mesh,
                 .kind = marks.kind,
                 .region = regions,
                 .number = std::move(numbers),
                 .curves = curves});
}

std::string left_out(const packed_scene& scene) {
    std::string text;
    const auto name = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
    };
    name(scene.plain_left_out, "other face", "other faces");
    name(scene.marked_left_out, "face of a pair", "faces of pairs");
    name(scene.segments_left_out, "curve segment", "curve segments");
    return text.empty() ? text : "Not drawn, to keep the page light: " + text + ".";
}

std::string joined(const std::set<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// For a column of a table: seven digits.
std::string in_brief(const tf::point3& p) {
    std::string text = "(";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        char digits[32];
        const auto end =
            std::to_chars(digits, digits + sizeof digits, p[axis], std::chars_format::general, 7)
                .ptr;
        text.append(axis == 0 ? "" : ", ").append(digits, end);
    }
    return text += ')';
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
        std::set<std::string> components;
        if (!result.component.empty())
            for (const std::uint32_t f : region.faces)
                components.insert(std::to_string(result.component[f]));
        rows.push_back({.cells = {{std::to_string(id), true},
                                  {joined(kinds[id])},
                                  {grouped(region.pairs), true},
                                  {grouped(region.faces.size()), true},
                                  {in_brief(center(region))},
                                  {in_brief(region.min) + " to " + in_brief(region.max)},
                                  {joined(components)}},
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
    std::vector<std::pair<std::string, std::string>> facts;
    facts.emplace_back("file", work.name + ", " + text_of("format"));
    facts.emplace_back("sha256", text_of("sha256"));
    facts.emplace_back("coordinates", text_of("precision_in") + ", unit " + work.options.unit);
    facts.emplace_back("faces", grouped(result.faces_stored) + " stored, " +
                                    grouped(result.triangles) + " triangles, " +
                                    grouped(result.mesh.faces.size()) + " searched");
    facts.emplace_back("vertices", grouped(result.points_stored) + " stored, " +
                                       grouped(result.points_distinct.value_or(0)) + " distinct");
    if (result.box)
        facts.emplace_back("box", in_words(result.box->min) + " to " + in_words(result.box->max));
    facts.emplace_back("left out", counted(result.non_finite, "face", "faces") + " not finite");
    facts.emplace_back(
        "degenerate",
        counted(result.degenerate, "face", "faces") + ", " +
            counted(result.found.counts[static_cast<std::size_t>(tf::pair_kind::degenerate)],
                    "pair", "pairs"));
    facts.emplace_back("tolerance", settings.tolerance.given + " (" +
                                        shortest(result.tolerance_used) + " in file units)");
    facts.emplace_back("program", std::string("tf-selfintersect ") + tf::version_string());
    return facts;
}

}  // namespace

void write_page(output_file& file, const job& work, const findings& result,
                const search_settings& settings) {
    page contents;
    contents.title = work.name;
    contents.verdict = verdict(result, settings);
    contents.good = result.pairs_that_count() == 0;
    contents.kinds = kinds_of(result);
    contents.scene = scene_of(result);
    const std::string format = work.entry.value("format", std::string());
    contents.y_is_up = format.starts_with("obj") || format.starts_with("gl");
    contents.view_note = left_out(contents.scene);
    contents.place_columns = {"region", "kinds", "pairs", "faces", "center", "box", "components"};
    contents.places = rows_of(result);
    if (result.regions.regions.size() > most_regions)
        contents.places_note = "The first " + grouped(most_regions) + " of " +
                               grouped(result.regions.regions.size()) +
                               "; the JSON report (-r) lists all.";
    contents.facts = facts_of(work, result, settings);
    file.write(html(contents));
}

}  // namespace tools
