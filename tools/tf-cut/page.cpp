#include "tools/shell/console.hpp"
#include "tools/shell/shown.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace tools {
namespace {

constexpr std::size_t most_classes = 200;  // of pieces; the others share the last

void add_pieces(scene& shown, const std::vector<cut_off>& pieces) {
    const std::size_t classes = std::min(pieces.size(), most_classes);
    for (std::size_t i = 0; i < classes; ++i)
        shown.classes.push_back({"piece " + std::to_string(i), scene_color(i), {}, true});
    const auto caps = static_cast<std::uint8_t>(classes);
    shown.classes.push_back({"caps", "#f08c00"});
    scene_table table{.title = "Pieces", .columns = {"piece", "faces", "volume", "area"}};
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const cut_off& piece = pieces[i];
        const auto own = static_cast<std::uint8_t>(std::min(i, classes - 1));
        scene_mesh mesh{.mesh = piece.mesh, .name = "piece " + std::to_string(i)};
        for (std::size_t f = 0; f < piece.mesh.faces.size(); ++f)
            mesh.kind.push_back(
                piece.cap.empty() || piece.cap[f] == tf::operand_element::none ? own : caps);
        mesh.number.assign(piece.face_source.begin(), piece.face_source.end());
        for (std::uint32_t& f : mesh.number)
            if (f == tf::operand_element::none) f = no_number;
        table.rows.push_back({.cells = {i, piece.mesh.faces.size(), piece.volume, piece.area},
                              .box = tf::bounding_box(piece.mesh.points)});
        shown.meshes.push_back(std::move(mesh));
    }
    shown.tables.push_back(std::move(table));
}

void add_lines(scene& shown, const drawn_lines& drawn) {
    shown.classes.push_back({drawn.name, "#e02020"});
    scene_lines lines{.kind = static_cast<std::uint8_t>(shown.classes.size() - 1)};
    lines.ends.assign(drawn.sides.begin(), drawn.sides.end());
    shown.lines.push_back(std::move(lines));
}

}  // namespace

void write_page(job& work, const usable_input& input, const std::string& verdict, bool good,
                const std::vector<cut_off>& pieces, const drawn_lines* lines) {
    if (!work.options.shows()) return;
    const auto timing = work.time("write");
    scene shown = scene_of(work, "tf-cut");
    shown.verdict = verdict;
    shown.good = good;
    if (!pieces.empty()) {
        add_pieces(shown, pieces);
    } else {
        shown.classes.push_back({"the mesh", "#b4bac2", {}, true});
        scene_mesh mesh{.mesh = input.file.mesh, .kind = {0}, .name = work.name};
        for (std::uint32_t f = 0; f < input.file.mesh.faces.size(); ++f)
            mesh.number.push_back(input.source().face_in_file(f));
        mesh.ghost = lines != nullptr;
        shown.meshes.push_back(std::move(mesh));
    }
    if (lines != nullptr) add_lines(shown, *lines);
    write_page(work, std::move(shown));
}

}  // namespace tools
