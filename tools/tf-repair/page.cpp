#include "tools/picture/scene.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-repair/outputs.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

/// Numbers of classes.
struct mark {
    enum number : std::uint8_t {
        kept,
        cut,
        flipped,
        filled,
        added,
        removed,
        meets,
        open_now,
        open_still
    };
};

/// What became of the faces before, and of what the faces after came.
struct fate {
    std::vector<std::uint8_t> before{};  ///< [F]
    std::vector<std::uint8_t> after{};   ///< [F']
};

/// The corners of a face, the least first, as floats: rounding when writing is no change.
using float_corners = std::array<std::array<float, 3>, 3>;
float_corners corners_of(tf::mesh_view mesh, std::size_t f, bool turned) {
    float_corners c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            c[i][axis] = static_cast<float>(mesh.points[mesh.faces[f][i]][axis]);
    if (turned) std::swap(c[1], c[2]);
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
}

fate compare(const dirty_mesh& input, tf::mesh_view made,
             const std::vector<std::uint32_t>& face_source,
             const std::vector<std::uint8_t>& is_kept, bool filled_holes) {
    const tf::mesh_view before = input.file.mesh;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> of_number;  // in the file, in `before`
    for (std::uint32_t f = 0; f < before.faces.size(); ++f)
        of_number.emplace_back(input.source().face_in_file(f), f);
    std::sort(of_number.begin(), of_number.end());
    fate result{
        std::vector<std::uint8_t>(before.faces.size(), mark::removed),
        std::vector<std::uint8_t>(made.faces.size(), filled_holes ? mark::filled : mark::added)};
    for (std::size_t f = 0; f < is_kept.size(); ++f)
        if (is_kept[f] != 0) result.before[f] = mark::cut;
    for (std::size_t f = 0; f < made.faces.size(); ++f) {
        if (face_source[f] == tf::repair_result::none) continue;
        std::uint8_t& own = result.after[f] = mark::cut;
        const float_corners same = corners_of(made, f, false), turned = corners_of(made, f, true);
        auto at =
            std::lower_bound(of_number.begin(), of_number.end(), std::pair{face_source[f], 0U});
        for (; at != of_number.end() && at->first == face_source[f]; ++at) {
            const float_corners was = corners_of(before, at->second, false);
            if (was != same && was != turned) continue;
            result.before[at->second] = own = was == same ? mark::kept : mark::flipped;
            break;
        }
    }
    return result;
}

void add_classes(scene& shown, const fate& was) {
    shown.classes = {
        {"as it was", "#b4bac2", {}, true}, {"cut or moved", "#f08c00"}, {"flipped", "#7432d6"},
        {"fills a hole", "#2e9e4f"},        {"added", "#00a0c0"},        {"removed", "#e02020"},
        {"meets another face", "#c2410c"},  {"open edges", "#d81fbf"},   {"border", "#10131a"}};
    std::array<std::uint64_t, mark::open_now> counts{};
    for (const std::uint8_t k : was.after) ++counts[k];
    counts[mark::removed] =
        static_cast<std::uint64_t>(std::count(was.before.begin(), was.before.end(), mark::removed));
    if (was.after.empty())
        for (const std::uint8_t k : was.before) ++counts[k];
    for (std::size_t k = 0; k < mark::open_now; ++k)
        shown.classes[k].count = counted(counts[k], "face", "faces");
}

void add_open_edges(scene& shown, tf::mesh_view mesh, const std::string& variant,
                    mark::number kind) {
    open_edges open = find_open_edges(mesh);
    if (open.ends.empty()) return;
    shown.classes[kind].count = counted(open.ends.size(), "edge", "edges");
    scene_lines lines{.kind = kind, .word = "open edge", .labeled = "number", .variant = variant};
    lines.width = 3.0;
    lines.ends = open.ends;
    if (kind == mark::open_now) {
        scene_table holes{.title = "Where the surface was open",
                          .columns = {"place", "edges", "box"}};
        constexpr std::uint32_t most = 1000;
        std::vector<std::vector<tf::point3>> points(std::min(open.holes, most));
        for (std::size_t e = 0; e < open.ends.size(); ++e)
            if (open.hole[e] < most)
                for (const tf::point3& p : open.ends[e]) points[open.hole[e]].push_back(p);
        for (std::size_t h = 0; h < points.size(); ++h) {
            const tf::box3 box = tf::bounding_box(points[h]).value_or(tf::box3{});
            holes.rows.push_back(
                {.cells = {h, points[h].size() / 2, in_words(box.min) + " to " + in_words(box.max)},
                 .box = box});
        }
        if (open.holes > most) holes.note = "The first 1,000 of " + grouped(open.holes) + ".";
        shown.tables.push_back(std::move(holes));
    }
    shown.lines.push_back(std::move(lines));
}

/// Numbers of the report, in its words.
void add_rows(scene_table& table, const std::string& step, const json& entry) {
    if (entry.is_null()) {
        table.rows.push_back({.cells = {step, "left out", ""}});
        return;
    }
    const std::size_t before = table.rows.size();
    for (const auto& [what, value] : entry.items()) {
        std::string words = what;
        std::replace(words.begin(), words.end(), '_', ' ');
        if (value.is_number() && value != 0) table.rows.push_back({.cells = {step, words, value}});
    }
    if (table.rows.size() == before) table.rows.push_back({.cells = {step, "nothing", ""}});
}

void add_tables(scene& shown, const job& work) {
    const json& repair = work.entry["repair"];
    if (repair.is_null()) return;
    scene_table steps{.title = "Steps", .columns = {"step", "what", "count"}};
    for (const auto& [step, entry] : repair["steps"].items()) add_rows(steps, step, entry);
    shown.tables.push_back(std::move(steps));
    scene_table sizes{.title = "Volume and area", .columns = {"", "before", "after"}};
    for (const char* key : {"volume", "area"})
        sizes.rows.push_back({.cells = {key, repair[key]["before"], repair[key]["after"]}});
    sizes.rows.push_back({.cells = {"faces", work.entry["triangles"], repair["faces"]}});
    for (scene_row& row : sizes.rows)
        for (json& cell : row.cells)
            if (cell.is_null()) cell = "none";
    shown.tables.push_back(std::move(sizes));
}

}  // namespace

void write_page(job& work, const dirty_mesh& input, const std::string& verdict, bool good,
                const tf::mesh& made, const std::vector<std::uint32_t>& face_source,
                const std::vector<std::uint8_t>& is_kept) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-repair");
    shown.verdict = verdict;
    shown.good = good;
    const tf::mesh_view before = input.file.mesh;
    const json& repair = work.entry["repair"];
    const bool filled_holes = repair.is_object() && repair["steps"]["fill"].is_object() &&
                              repair["steps"]["fill"]["holes"].get<std::uint64_t>() > 0;
    const bool after = !made.faces.empty();
    fate was = compare(input, made, face_source, is_kept, filled_holes);
    if (!after) {
        std::fill(was.before.begin(), was.before.end(), mark::kept);
        const tf::mesh joined = tf::join_meshes({&before, 1});
        const auto found = tf::self_intersections(
            joined, {.vertices = tf::vertex_identity::by_index, .progress = work.progress("page")});
        work.call_ended(found.status == tf::status::cancelled);
        for (const tf::face_pair& pair : found.pairs)
            was.before[pair.a] = was.before[pair.b] = mark::meets;
    }
    add_classes(shown, was);
    if (!after) shown.classes[mark::kept].name = "other";
    scene_mesh first{.mesh = before, .kind = was.before, .name = after ? "the input" : ""};
    for (std::uint32_t f = 0; f < before.faces.size(); ++f)
        first.number.push_back(input.source().face_in_file(f));
    first.variant = after ? "before" : "";
    shown.meshes.push_back(std::move(first));
    if (after)
        shown.meshes.push_back({.mesh = made,
                                .kind = was.after,
                                .name = "the result",
                                .group_word = "in face",
                                .group = face_source,
                                .variant = "after"});
    add_open_edges(shown, before, after ? "before" : "", mark::open_now);
    if (after) add_open_edges(shown, made, "after", mark::open_still);
    add_tables(shown, work);
    write_page(work, std::move(shown));
}

}  // namespace tools
