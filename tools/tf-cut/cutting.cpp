#include "tools/tf-cut/cutting.hpp"

#include "tools/shell/console.hpp"
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tools {
namespace {

json planes_entry(const cut_settings& s) {
    if (s.mode >= cut_mode::parts || s.bed) return nullptr;
    if (s.mode == cut_mode::isolines)
        return {{"at", s.plane.at}, {"normal", s.plane.normal}, {"heights", nullptr}};
    return {{"at", s.plane.at}, {"normal", s.plane.normal}, {"heights", s.heights}};
}

std::string size_in_words(double x, double y, double z) {
    return brief(x) + " x " + brief(y) + " x " + brief(z);
}

/// The least box, turned; in words where it is less than the one along the axes.
std::string turned_box(job& work, const tf::mesh& mesh, const std::optional<tf::box3>& box) {
    constexpr double less = 0.99;
    std::vector<tf::point3> points = mesh.points;
    std::erase_if(points, [](const tf::point3& p) {
        return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    });
    const auto turned = tf::find_oriented_box(points);
    if (!turned) return {};
    const tf::point3& size = turned->size;
    work.entry["info"]["oriented_box"] = {
        {"center", turned->center}, {"axes", turned->axes}, {"size", size}};
    const double straight =
        (box->max.x - box->min.x) * (box->max.y - box->min.y) * (box->max.z - box->min.z);
    if (!(size.x * size.y * size.z < less * straight)) return {};
    return " (turned " + size_in_words(size.x, size.y, size.z) + ")";
}

/// Enters where the solid is thinnest, if that is asked for.
std::string thinnest_wall(job& work, const cut_settings& s, const usable_input& input) {
    if (s.walls == measured_walls::none) return {};
    const tf::thickness_result found = tf::wall_thickness(
        input.file.mesh,
        s.walls == measured_walls::ray ? tf::thickness_by::ray : tf::thickness_by::sphere,
        work.progress("walls"));
    work.call_ended(found.status == tf::status::cancelled);
    if (!std::isfinite(found.min)) return {};
    tf::point3 middle{};
    for (const std::uint32_t v : input.file.mesh.faces[found.thinnest])
        for (std::size_t k = 0; k < 3; ++k) middle[k] += input.file.mesh.points[v][k] / 3;
    work.entry["info"]["thinnest"] = {{"by", wall_measures[static_cast<std::size_t>(s.walls)]},
                                      {"thickness", found.min},
                                      {"face", input.source().face_in_file(found.thinnest)},
                                      {"at", middle}};
    return ", thinnest wall " + brief(found.min) + " at " + in_words(middle);
}

bool has_caps(const cut_settings& s) {
    return s.mode == cut_mode::half || s.mode == cut_mode::pieces;
}

const char* word_for(const cut_settings& s, std::size_t count) {
    if (s.mode == cut_mode::parts) return count == 1 ? " part" : " parts";
    return count == 1 ? " piece" : " pieces";
}

std::string volume_in_words(const std::optional<double>& volume) {
    return volume ? "volume " + brief(*volume) : "open";
}

/// "the mesh is between heights 0 and 1", along the normal.
std::string heights_in_words(const cut_settings& s, const usable_input& input) {
    const auto [low, high] = range_of(input, heights_of(s, input));
    return "the mesh is between heights " + brief(low) + " and " + brief(high);
}

/// Pieces that are empty, so that they are not among those `made`.
void warn_of_missing(job& work, const cut_settings& s, const usable_input& input,
                     std::size_t made) {
    const std::string nothing = "there is nothing to write: ";
    if (s.keeps_one()) {
        if (work.entry["pieces"][0]["faces"] == 0)
            work.warn("no-pieces", "the kept half is empty: " + heights_in_words(s, input));
    } else if (made == 0) {
        const bool parts = s.mode == cut_mode::parts;
        work.warn("no-pieces", nothing + (parts ? "no part reaches --min-volume"
                                                : "the faces enclose no volume"));
    } else if (has_caps(s) && !s.bed) {
        const std::size_t asked = std::set<double>(s.heights.begin(), s.heights.end()).size() + 1;
        if (made < asked)
            work.warn("no-cut", counted(asked - made, "piece is", "pieces are") +
                                    " empty: " + heights_in_words(s, input));
    }
}

}  // namespace

std::optional<double> volume_of(const tf::mesh& mesh) {
    if (tf::find_open_edge(tf::join_equal_points(mesh))) return {};
    return tf::signed_volume(mesh);
}

cut_off cut_off_of(tf::mesh&& mesh, std::vector<std::uint32_t>&& face_source,
                   std::vector<std::uint32_t>&& vertex_source, tf::certificate&& known) {
    cut_off made;
    made.face_source = std::move(face_source);
    made.vertex_source = std::move(vertex_source);
    made.face_source.resize(mesh.faces.size(), tf::operand_element::none);
    made.vertex_source.resize(mesh.points.size(), tf::operand_element::none);
    made.volume = volume_of(mesh);
    made.area = tf::surface_area(mesh);
    made.mesh = std::move(mesh);
    made.certificate = std::move(known);
    return made;
}

double diagonal_of(const usable_input& input) {
    const auto box = tf::bounding_box(input.file.mesh.points);
    return box ? box->diagonal() : 0.0;
}

void enter_blank_report(job& work, const cut_settings& s, const usable_input& input) {
    json& entry = work.entry;
    entry["mode"] = cut_modes[static_cast<std::size_t>(s.mode)];
    entry["vertices"] = input.file.mesh.points.size();
    entry["faces"] = input.file.stored_faces;
    entry["triangles"] = input.file.mesh.faces.size() + input.non_finite;
    entry["skipped"]["non_finite"] = input.non_finite;
    entry["planes"] = planes_entry(s);
    entry["max_move"] = {{"given", s.limits.max_move.given},
                         {"used", nullptr},
                         {"largest", nullptr},
                         {"step", nullptr}};
    for (const char* key :
         {"layers", "isolines", "pieces", "distances", "cavities", "info", "output"})
        entry[key] = nullptr;
}

void say_section(job& work, const cut_settings& s, const usable_input& input,
                 const tf::section_result& made) {
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
    if (made.loops.empty())
        work.warn("no-loops", "no plane meets the mesh: " + heights_in_words(s, input));
    if (open > 0)
        work.warn("open-loops", counted(open, "polyline is", "polylines are") +
                                    " open, since the surface is open there; tf-repair closes it");
    if (unsure > 0)
        work.warn("unoriented-loops",
                  counted(static_cast<std::uint64_t>(unsure), "polyline runs", "polylines run") +
                      " along inconsistently oriented faces; tf-repair orients them");
}

void say_pieces(job& work, const cut_settings& s, const usable_input& input,
                const std::vector<cut_off>& pieces) {
    constexpr std::size_t most_in_words = 4;
    json list = json::array();
    std::string text;
    double volume = 0.0;
    std::size_t open = 0;
    for (const cut_off& piece : pieces) {
        const auto caps = piece.cap.size() - static_cast<std::size_t>(std::ranges::count(
                                                 piece.cap, tf::operand_element::none));
        list.push_back({{"vertices", piece.mesh.points.size()},
                        {"faces", piece.mesh.faces.size()},
                        {"cap_faces", or_null(has_caps(s), caps)},
                        {"volume", or_null(piece.volume.has_value(), piece.volume.value_or(0.0))},
                        {"area", piece.area},
                        {"certified",
                         or_null(s.mode != cut_mode::parts, static_cast<bool>(piece.certificate))},
                        {"file", nullptr}});
        volume += piece.volume.value_or(0.0);
        open += piece.volume ? 0 : 1;
        text += (text.empty() ? ": " : "; ") + counted(piece.mesh.faces.size(), "face", "faces") +
                ", " + volume_in_words(piece.volume);
    }
    work.entry["pieces"] = std::move(list);
    if (pieces.size() > most_in_words) {
        text = open < pieces.size() ? ", total volume " + brief(volume) : std::string();
        if (open > 0) text += ", " + grouped(open) + " open";
    }
    if (const json& reached = work.entry["distances"]; reached.is_object())
        text +=
            (s.mode == cut_mode::simplify ? ", at most "
                                          : ", " + brief(reached["min"].get<double>()) + " to ") +
            brief(reached["max"].get<double>()) + " away";
    work.out.result(work.name + ": " + grouped(pieces.size()) + word_for(s, pieces.size()) + text);
    warn_of_missing(work, s, input, pieces.size());
}

void say_info(job& work, const cut_settings& s, const usable_input& input) {
    const tf::mesh& mesh = input.file.mesh;
    const auto timing = work.time("check");
    tf::solid_defects defects = tf::find_solid_defects(input.source(), work.progress("check"));
    work.call_ended(defects.status == tf::status::cancelled);
    defects.unusable_faces += input.non_finite;
    const auto box = tf::bounding_box(mesh.points);
    const tf::mesh joined = tf::join_equal_points(mesh);
    std::optional<double> volume;
    if (!tf::find_open_edge(joined)) volume = tf::signed_volume(mesh);
    const auto mass = volume ? tf::find_mass_properties(mesh) : std::nullopt;
    const std::uint64_t parts =
        tf::count_topology(joined.points.size(), joined.faces).components_by_point;
    const double area = tf::surface_area(mesh);
    const std::string unit = work.unit();
    work.entry["info"] = {{"unit", or_null(!unit.empty(), unit)},
                          {"box", box ? json{{"min", box->min}, {"max", box->max}} : json(nullptr)},
                          {"oriented_box", nullptr},
                          {"solid", !defects.any()},
                          {"defects", defects.message()},
                          {"components", parts},
                          {"area", area},
                          {"volume", or_null(volume.has_value(), volume.value_or(0.0))},
                          {"center", mass ? json(mass->center) : json(nullptr)},
                          {"inertia", mass ? json(mass->inertia) : json(nullptr)},
                          {"thinnest", nullptr}};
    std::string text = counted(mesh.faces.size(), "face", "faces");
    if (box)
        text += ", " + size_in_words(box->max.x - box->min.x, box->max.y - box->min.y,
                                     box->max.z - box->min.z);
    if (!unit.empty()) text += " " + unit;
    text += turned_box(work, joined, box);
    text += defects.any() ? ", not a solid: " + defects.message() : std::string(", solid");
    text += "; " + counted(parts, "component", "components");
    if (std::isfinite(area)) text += ", area " + brief(area);
    if (volume && std::isfinite(*volume)) text += ", volume " + brief(*volume);
    if (mass) text += ", center " + in_words(mass->center);
    if (!defects.any()) text += thinnest_wall(work, s, input);
    work.out.result(work.name + ": " + text);
    if (!std::isfinite(area) || (volume && !std::isfinite(*volume)))
        work.warn("too-large", "the area or the volume is beyond the range of doubles");
}

}  // namespace tools
