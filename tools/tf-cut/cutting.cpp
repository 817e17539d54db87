#include "tools/tf-cut/cutting.hpp"

#include "tools/common/console.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <algorithm>

namespace tools {
namespace {

json planes_entry(const cut_settings& s) {
    if (s.mode == cut_mode::parts || s.mode == cut_mode::info || s.bed) return nullptr;
    return {{"at", s.plane.at}, {"normal", s.plane.normal}, {"heights", s.heights}};
}

std::string size_in_words(const tf::box3& box) {
    return brief(box.max.x - box.min.x) + " x " + brief(box.max.y - box.min.y) + " x " +
           brief(box.max.z - box.min.z);
}

const char* word_for(const cut_settings& s, std::size_t count) {
    if (s.mode == cut_mode::parts) return count == 1 ? " part" : " parts";
    return count == 1 ? " piece" : " pieces";
}

}  // namespace

double diagonal_of(const cut_input& input) {
    const auto box = tf::bounding_box(input.file.mesh.points);
    return box ? tf::diagonal(*box) : 0.0;
}

void enter_blank_report(job& work, const cut_settings& s, const cut_input& input) {
    json& entry = work.entry;
    entry["mode"] = cut_modes[static_cast<std::size_t>(s.mode)];
    entry["vertices"] = input.file.mesh.points.size();
    entry["faces"] = input.file.stored_faces;
    entry["triangles"] = input.file.mesh.faces.size() + input.left_out;
    entry["skipped"]["non_finite"] = input.left_out;
    entry["planes"] = planes_entry(s);
    entry["max_move"] = {{"given", s.rails.max_move.given},
                         {"used", nullptr},
                         {"largest", nullptr},
                         {"step", nullptr}};
    for (const char* key : {"layers", "pieces", "info", "output"}) entry[key] = nullptr;
}

void say_section(job& work, const tf::section_result& made) {
    json layers = json::array();
    std::uint64_t open = 0;
    double area = 0.0, length = 0.0;
    for (const tf::section_layer& layer : made.layers) {
        layers.push_back({{"height", layer.height},
                          {"loops", layer.loop_count},
                          {"open", layer.open_count},
                          {"area", layer.area},
                          {"length", layer.length}});
        open += layer.open_count;
        area += layer.area;
        length += layer.length;
    }
    work.entry["layers"] = std::move(layers);
    std::string text = counted(made.loops.size(), "loop", "loops");
    if (made.layers.size() > 1)
        text = counted(made.layers.size(), "layer", "layers") + ", " + text;
    else
        text += ", area " + brief(area) + ", length " + brief(length);
    work.out.result(work.name + ": " + text);
    const auto unsure = std::ranges::count_if(
        made.loops, [](const tf::section_loop& loop) { return !loop.oriented; });
    if (open > 0)
        work.warn("open-loops", counted(open, "polyline is", "polylines are") +
                                    " open, for the surface ends there; tf-repair closes it");
    if (unsure > 0)
        work.warn("turned-loops",
                  counted(static_cast<std::uint64_t>(unsure), "polyline runs", "polylines run") +
                      " along faces that disagree in their orientation; tf-repair turns them");
}

void say_pieces(job& work, const cut_settings& s, const std::vector<cut_off>& pieces) {
    constexpr std::size_t most_in_words = 4;
    json list = json::array();
    std::string text;
    double volume = 0.0;
    for (const cut_off& piece : pieces) {
        const auto caps = piece.cap.size() - static_cast<std::size_t>(std::ranges::count(
                                                 piece.cap, tf::operand_element::none));
        list.push_back({{"vertices", piece.mesh.points.size()},
                        {"faces", piece.mesh.faces.size()},
                        {"cap_faces", or_null(s.mode != cut_mode::parts, caps)},
                        {"volume", piece.volume},
                        {"area", piece.area},
                        {"certified",
                         or_null(s.mode != cut_mode::parts, static_cast<bool>(piece.certificate))},
                        {"file", nullptr}});
        volume += piece.volume;
        text += (text.empty() ? ": " : "; ") + counted(piece.mesh.faces.size(), "face", "faces") +
                ", volume " + brief(piece.volume);
    }
    work.entry["pieces"] = std::move(list);
    if (pieces.size() > most_in_words) text = ", volume " + brief(volume) + " in all";
    work.out.result(work.name + ": " + grouped(pieces.size()) + word_for(s, pieces.size()) + text);
}

void say_info(job& work, const cut_input& input) {
    const tf::mesh& mesh = input.file.mesh;
    const auto timing = work.time("check");
    tf::solid_defects defects =
        tf::find_solid_defects(input.source(), tf::repair_scope::each_part, work.progress("check"));
    work.call_ended(defects.cancelled);
    defects.unusable_faces += input.left_out;
    const auto box = tf::bounding_box(mesh.points);
    const auto mass = tf::find_mass_properties(mesh);
    const tf::mesh joined = tf::join_equal_points(mesh);
    const std::uint64_t parts =
        tf::count_topology(joined.points.size(), joined.faces).components_by_point;
    const double area = tf::surface_area(mesh);
    work.entry["info"] = {{"box", box ? json{{"min", box->min}, {"max", box->max}} : json(nullptr)},
                          {"solid", !defects.any()},
                          {"defects", defects.message()},
                          {"components", parts},
                          {"area", area},
                          {"volume", mass ? mass->volume : 0.0},
                          {"center", mass ? json(mass->center) : json(nullptr)},
                          {"inertia", mass ? json(mass->inertia) : json(nullptr)}};
    std::string text = counted(mesh.faces.size(), "face", "faces");
    if (box) text += ", " + size_in_words(*box);
    text += defects.any() ? ", no solid: " + defects.message() : std::string(", solid");
    text += "; " + counted(parts, "component", "components") + ", area " + brief(area);
    if (mass) text += ", volume " + brief(mass->volume) + ", center " + in_words(mass->center);
    work.out.result(work.name + ": " + text);
}

}  // namespace tools
