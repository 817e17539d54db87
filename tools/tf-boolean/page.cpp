#include "tools/picture/scene.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-boolean/outputs.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

constexpr std::size_t most_inputs = 100;  // with a class of their own; the others share the last
constexpr std::size_t most_ghosts = 3;    // shown at first

/// Classes: a source each, then an input each, then lines.
struct numbering {
    std::size_t inputs = 0;
    [[nodiscard]] std::uint8_t source(std::size_t i) const {
        return static_cast<std::uint8_t>(std::min(i, inputs - 1));
    }
    [[nodiscard]] std::uint8_t input(std::size_t i) const {
        return static_cast<std::uint8_t>(inputs + std::min(i, inputs - 1));
    }
    [[nodiscard]] std::uint8_t curves() const { return static_cast<std::uint8_t>(2 * inputs); }
    [[nodiscard]] std::uint8_t open() const { return static_cast<std::uint8_t>(2 * inputs + 1); }
};

void add_result(scene& shown, const numbering& kinds, const std::vector<solid>& solids,
                const tf::boolean_result& made) {
    scene_mesh mesh{.mesh = made.mesh, .name = "the result", .group_word = "in face"};
    std::vector<std::uint64_t> counts(solids.size(), 0);
    for (const tf::operand_element& source : made.face_source) {
        mesh.kind.push_back(kinds.source(source.operand));
        mesh.group.push_back(solids[source.operand].face_in_file(source.index));
        ++counts[source.operand];
    }
    for (std::size_t i = 0; i < kinds.inputs; ++i)
        shown.classes[i].count = counted(counts[i], "face", "faces");
    shown.meshes.push_back(std::move(mesh));
}

void add_input(scene& shown, const numbering& kinds, const solid& input, std::size_t i,
               bool ghost) {
    scene_mesh mesh{.mesh = input.file.mesh,
                    .kind = {ghost ? kinds.input(i) : kinds.source(i)},
                    .name = name_of(input),
                    .ghost = ghost};
    for (std::uint32_t f = 0; f < input.file.mesh.faces.size(); ++f)
        mesh.number.push_back(input.face_in_file(f));
    shown.meshes.push_back(std::move(mesh));
}

void add_curves(scene& shown, job& work, const numbering& kinds, const std::vector<solid>& solids) {
    const auto [joined, pairs] = meetings_of(work, solids);
    scene_lines lines{.kind = kinds.curves(),
                      .ends = tf::intersection_curves(joined, pairs).answers};
    shown.lines.push_back(std::move(lines));
}

void add_tables(scene& shown, const json& entry) {
    scene_table table{.title = "Volumes", .columns = {"of", "volume", "faces"}};
    const auto add = [&](const std::string& name, const json& volume, const json& faces) {
        if (volume.is_number()) table.rows.push_back({.cells = {name, volume, faces}});
    };
    for (const json& input : entry["inputs"])
        add(input["file"].get<std::string>() +
                (input["part"].is_string() ? ": " + input["part"].get<std::string>() : ""),
            input["volume"], input["triangles"]);
    if (entry["volumes"].is_object())
        for (const char* key : {"union", "intersection"}) add(key, entry["volumes"][key], "");
    if (entry["output"].is_object())
        add("the result", entry["output"]["volume"], entry["output"]["faces"]);
    shown.tables.push_back(std::move(table));
}

}  // namespace

void write_page(job& work, const std::vector<solid>& solids, const std::string& verdict, bool good,
                const tf::boolean_result* made) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-boolean");
    shown.verdict = verdict;
    shown.good = good;
    const numbering kinds{std::min(solids.size(), most_inputs)};
    const bool ghosts = made != nullptr && !made->mesh.faces.empty();
    for (std::size_t i = 0; i < kinds.inputs; ++i)
        shown.classes.push_back(
            {(ghosts ? "from " : "") + name_of(solids[i]), scene_color(i), {}, true});
    for (std::size_t i = 0; i < kinds.inputs; ++i)
        shown.classes.push_back({"input " + name_of(solids[i]),
                                 scene_color(i),
                                 {},
                                 true,
                                 solids.size() <= most_ghosts});
    shown.classes.push_back({"where inputs meet", "#10131a"});
    shown.classes.push_back({"open edges", "#d81fbf"});
    if (ghosts) add_result(shown, kinds, solids, *made);
    for (std::size_t i = 0; i < solids.size(); ++i) {
        add_input(shown, kinds, solids[i], i, ghosts);
        if (made != nullptr && made->certificate.open_edges.empty()) continue;
        open_edges open = find_open_edges(solids[i].file.mesh);
        scene_lines lines{.kind = kinds.open(), .ends = std::move(open.ends), .word = "open edge"};
        lines.width = 3.0;
        shown.lines.push_back(std::move(lines));
    }
    if (made != nullptr) add_curves(shown, work, kinds, solids);
    add_tables(shown, work.entry);
    write_page(work, std::move(shown));
}

}  // namespace tools
