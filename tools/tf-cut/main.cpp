/// \file
/// tf-cut: sections, halves and pieces of meshes by planes; their parts; what they are.

#include "tools/common/command_line.hpp"
#include "tools/common/common_options.hpp"
#include "tools/common/console.hpp"
#include "tools/common/mesh_output.hpp"
#include "tools/common/run.hpp"
#include "tools/tf-cut/cutting.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace {

using tools::command_line;
using tools::common_options;
using tools::cut_mode;
using tools::cut_off;
using tools::cut_settings;
using tools::exit_status;
using tools::refuse;
using tools::usable_input;

const std::vector<std::string> of_planes{"--normal", "--at", "--height"};
const std::vector<std::string> of_one{"--in-place", "--output-dir", "--suffix"};
const std::vector<std::string> of_meshes{"--output-format", "--precision", "--ascii", "--binary"};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

void add_shape_modes(command_line& line) {
    const std::vector<std::string> without = both(of_planes, {"--max-move"});
    line.mode({.names = "simplify",
               .text = "fewer faces, both surfaces within a distance, proven",
               .usage = "simplify --distance D [OPTIONS] INPUT...",
               .more = "Faces that meet stay as they are, and none are made to. Takes about a\n"
                       "millisecond a face.\n\nExamples:\n"
                       "  $ tf-cut simplify data/sphere.ply --distance 0.01 -o fewer.ply\n"
                       "  data/sphere.ply: 1 piece: 464 faces, volume 4.1282\n",
               .without = without});
    line.mode({.names = "offset",
               .text = "the solid grown by a distance, or shrunk by -D",
               .usage = "offset --distance D [OPTIONS] INPUT...",
               .more = "Reports between which distances all of the result is.\n\nExamples:\n"
                       "  $ tf-cut offset data/cube.stl --distance 0.25 --resolution 0.1 -o "
                       "grown.stl\n"
                       "  data/cube.stl: 1 piece: 9,000 faces, volume 3.1403\n",
               .without = without});
    line.mode({.names = "hollow",
               .text = "the solid with cavities, its surface as it is",
               .usage = "hollow --wall W [OPTIONS] INPUT...",
               .more = "Holes are drilled by --drain.\n\nExamples:\n"
                       "  $ tf-cut hollow data/cube.stl --wall 0.1 --resolution 0.05 -o shell.stl\n"
                       "  data/cube.stl: 1 piece: 11,916 faces, volume 0.493755\n",
               .without = without});
    line.mode({.names = "thicken",
               .text = "a solid around a surface, which may be open",
               .usage = "thicken --thickness T [OPTIONS] INPUT...",
               .more = "Its rim is round.\n\nExamples:\n"
                       "  $ tf-cut thicken data/cube.stl --thickness 0.2 --resolution 0.05 -o "
                       "solid.stl\n"
                       "  data/cube.stl: 1 piece: 36,744 faces, volume 1.18758\n",
               .without = without});
}

void add_modes(command_line& line) {
    line.group("Modes");
    line.mode({.names = "half",
               .text = "what is below the plane, above it, or both",
               .usage = "half --height H [OPTIONS] INPUT...",
               .more = "Prints faces and volume of each half.\n\nExamples:\n"
                       "  $ tf-cut half data/sphere.ply --height 0.25 --keep above -o top.ply\n"
                       "  data/sphere.ply: 1 piece: 662 faces, volume 1.31185\n"});
    line.mode({.names = "section",
               .text = "the loops in the planes, as SVG, DXF, OBJ, JSON",
               .usage = "section --height H[,H...] [OPTIONS] INPUT...",
               .more = "Prints how many layers and loops there are; of a single plane, area and\n"
                       "length, too.\n\nExamples:\n"
                       "  $ tf-cut section data/two_spheres.stl --layers 0.5 -o layers.svg\n"
                       "  data/two_spheres.stl: 4 layers, 8 loops\n",
               .without = both(both(of_meshes, of_one), {"--max-move"})});
    line.mode({.names = "pieces",
               .text = "what is between planes, or fits a printer's bed",
               .usage = "pieces --bed X,Y[,Z] [OPTIONS] INPUT...",
               .more = "Prints faces and volumes of the pieces.\n\nExamples:\n"
                       "  $ tf-cut pieces data/sphere.ply --bed 1,2 -o piece_%d.ply\n"
                       "  data/sphere.ply: 2 pieces: 702 faces, volume 2.07637; 702 faces, volume "
                       "2.07637\n",
               .without = of_one});
    line.mode({.names = "parts",
               .text = "the faces that corners link, each by themselves",
               .usage = "parts [OPTIONS] INPUT...",
               .more = "Prints faces and volumes of the parts. A cavity goes with the part around\n"
                       "it.\n\nExamples:\n"
                       "  $ tf-cut parts data/two_spheres.stl --largest 1 -o part.stl\n"
                       "  data/two_spheres.stl: 1 part: 320 faces, volume 4.04704\n",
               .without = both(both(of_planes, of_one), {"--max-move"})});
    line.mode({.names = "info",
               .text = "size, solid or why not, area, volume, center",
               .usage = "info [OPTIONS] INPUT...",
               .more =
                   "Of many inputs, prints a table at the end.\n\nExamples:\n"
                   "  $ tf-cut info data/cube.stl\n"
                   "  data/cube.stl: 12 faces, 1 x 1 x 1, solid; 1 component, area 6, volume 1, "
                   "center (0.5, 0.5, 0.5)\n",
               .without = both(both(both(of_planes, of_meshes), of_one),
                               {"--output", "--dry-run", "--max-move"})});
    add_shape_modes(line);
}

void add_distances(command_line& line, tools::shape_settings& s) {
    line.group("Distances");
    line.option({"--distance", "D",
                 "simplify, offset: how far apart both surfaces may be;\n"
                 "how far the solid grows, or shrinks below 0"},
                [&s](std::string_view v) {
                    const bool shrinks = v.starts_with('-');
                    s.distance = tools::parse_distance("--distance", v.substr(shrinks ? 1 : 0));
                    if (!shrinks) return;
                    s.distance.value = -s.distance.value;
                    s.distance.given.insert(0, "-");
                });
    line.option({"--wall", "W", "hollow: how thick the wall is"},
                [&s](std::string_view v) { s.distance = tools::parse_distance("--wall", v); });
    line.option({"--thickness", "T", "thicken: how thick the solid is"},
                [&s](std::string_view v) { s.distance = tools::parse_distance("--thickness", v); });
    line.option(
        {"--resolution", "R",
         "offset, hollow, thicken: edge of the cells that the\n"
         "surface is made in, at most half of the distance"},
        [&s](std::string_view v) { s.resolution = tools::parse_number("--resolution", v); });
    line.option(s.side, {"--side", "SIDE", "thicken: both | front | back", "both"},
                tools::thick_sides);
    line.option({"--drain", "X,Y,Z,D",
                 "hollow: a hole of this diameter at the nearest point;\n"
                 "may be repeated"},
                [&s](std::string_view v) {
                    const auto n = tools::parse_numbers("--drain", v, 4);
                    s.drains.push_back({{n[0], n[1], n[2]}, n[3]});
                });
    line.option(s.fewest_faces, {"--faces", "N", "simplify: stop at so many faces", "0"});
}

void add_options(command_line& line, cut_settings& s) {
    line.group("Planes");
    line.option(
        {"--normal", "X,Y,Z", "across the plane; above is where it points", "0,0,1"},
        [&s](std::string_view v) { s.plane.normal = tools::parse_direction("--normal", v); });
    line.option({"--at", "X,Y,Z", "a point of the plane", "0,0,0"},
                [&s](std::string_view v) { s.plane.at = tools::parse_point("--at", v); });
    line.option({"--height", "H,...", "planes so far above --at, along the normal", "0"},
                [&s](std::string_view v) {
                    const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
                    s.heights = tools::parse_numbers("--height", v, count);
                });
    line.option({"--layers", "T",
                 "section: planes in the middles of layers of this\n"
                 "thickness, from the lowest point to the highest"},
                [&s](std::string_view v) { s.layers = tools::parse_number("--layers", v); });
    line.option({"--bed", "X,Y[,Z]",
                 "pieces: that fit into this, across x, y and z, as few\n"
                 "as there can be, of equal length"},
                [&s](std::string_view v) {
                    const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
                    const auto size = tools::parse_numbers("--bed", v, count == 2 ? 2 : 3);
                    s.bed = {size[0], size[1],
                             count == 2 ? std::numeric_limits<double>::infinity() : size[2]};
                });
    add_distances(line, s.shape);
    line.group("Options");
    line.option(s.keep, {"--keep", "HALF", "half: both | below | above", "both"},
                tools::kept_halves);
    line.flag(s.open, {"--open", "",
                       "half, pieces: cut a surface, which may end anywhere,\n"
                       "and leave the pieces open"});
    tools::add_max_move(line, s.limits);
    line.option(
        {"--min-volume", "V", "parts: leave out those below V; open ones have none", "0"},
        [&s](std::string_view v) { s.min_volume = tools::parse_volume("--min-volume", v); });
    line.option(s.largest, {"--largest", "N", "parts: only the N of the greatest volume", "all"});
}

void add_what_to_give_back(command_line& line, cut_settings& s) {
    line.group("What to give back");
    line.output(s.output, {"-o, --output", "FILE",
                           "where the result goes: loops as svg, dxf, obj or json;\n"
                           "pieces as meshes, \"%d\" in the name being the number\n"
                           "of each, or as objects of one 3MF, OBJ or GLB"});
    line.option(s.caps, {"--caps", "P",
                         "half, pieces: write the number of its plane for each\n"
                         "face of a cap to property P of a PLY or GLB, else -1"});
}

const char* const epilogue =
    "Lengths are in the unit of the file, V in its cube. Heights are along the normal\n"
    "at length 1. Which side of a plane a vertex is on, and what makes a loop, is\n"
    "decided exactly, on the coordinates as read; points on cuts are rounded.\n"
    "\n"
    "A section is that of a plane just below: a vertex in the plane counts as above.\n"
    "Loops of a solid are closed, counter-clockwise where they are outer ones, and\n"
    "clockwise where they are holes. Where the surface ends, they are open, and a\n"
    "warning says so. SVG, DXF and JSON have coordinates in the plane: (x, y) across\n"
    "z, (y, z) across x, (z, x) across y; OBJ has lines in space.\n"
    "\n"
    "Pieces are closed by caps, and have been checked in the coordinates written:\n"
    "they are closed, oriented and free of self-intersections. Two pieces have the\n"
    "same cap, turned. The input has to bound a solid, unless --open is given; where\n"
    "it meets itself, the solid that it winds around is cut. Pieces are numbered from\n"
    "0, from the lowest up; with --bed by x, then y, then z.\n"
    "\n"
    "Examples:\n"
    "  tf-cut half part.stl --at 0,0,12.5 --normal 0,1,1 -o half_%d.stl\n"
    "  tf-cut section part.stl --layers 0.2 -o layers.svg\n"
    "  tf-cut pieces statue.stl --bed 250,210,220 -o piece_%d.stl\n"
    "  tf-cut parts assembly.stl --min-volume 1 -o parts.3mf\n"
    "  tf-cut info *.stl -r table.json\n"
    "\n"
    "Exit status: 0 done; 1 the input bounds no solid (the report says where) or a\n"
    "  piece could not be certified; 2 usage; 3 input; 4 output; 5 stopped (memory,\n"
    "  timeout, signal); 70 bug. Of several inputs, the highest.\n";

const char* option_of(cut_mode mode) {
    return mode == cut_mode::hollow    ? "--wall"
           : mode == cut_mode::thicken ? "--thickness"
                                       : "--distance";
}

void check_mode(const command_line& line, cut_settings& s) {
    const auto at = std::ranges::find(tools::cut_modes, s.mode_text);
    if (at == tools::cut_modes.end())
        refuse(s.mode_text + ": no mode; expected one of " + tools::listed(tools::cut_modes));
    s.mode = static_cast<cut_mode>(at - tools::cut_modes.begin());
    const auto only = [&](const char* name, std::initializer_list<cut_mode> modes) {
        if (line.given(name) && std::ranges::find(modes, s.mode) == modes.end())
            refuse(std::string(name) + " is not for " + s.mode_text);
    };
    using enum cut_mode;
    for (const char* name : {"--normal", "--at", "--height"}) only(name, {half, section, pieces});
    for (const char* name : {"--open", "--caps", "--max-move"}) only(name, {half, pieces});
    for (const char* name : {"--min-volume", "--largest"}) only(name, {parts});
    only("--layers", {section});
    only("--bed", {pieces});
    only("--keep", {half});
    for (const char* name : {"--output", "--dry-run"})
        only(name, {half, section, pieces, parts, simplify, offset, hollow, thicken});
    for (const std::string& name : of_meshes)
        only(name.c_str(), {half, pieces, parts, simplify, offset, hollow, thicken});
    for (const std::string& name : of_one)
        only(name.c_str(), {half, simplify, offset, hollow, thicken});
    only("--distance", {simplify, offset});
    only("--resolution", {offset, hollow, thicken});
    only("--faces", {simplify});
    for (const char* name : {"--wall", "--drain"}) only(name, {hollow});
    for (const char* name : {"--thickness", "--side"}) only(name, {thicken});
    const auto needs = [&](cut_mode mode, const char* name) {
        if (s.mode == mode && !line.given(name)) refuse(s.mode_text + ": give " + name);
    };
    for (const cut_mode mode : {simplify, offset, hollow, thicken}) needs(mode, option_of(mode));
    const bool placed = line.given("--at") || line.given("--height");
    if (s.mode == half && !placed) refuse("half: where? give --height or --at");
    if (s.mode == half && s.heights.size() > 1) refuse("half: one --height; pieces takes several");
    if (line.given("--layers") && s.layers <= 0.0)
        refuse("--layers: a thickness above 0 is needed");
    if (s.mode == section && !placed && s.layers == 0.0)
        refuse("section: where? give --height, --at or --layers");
    if (line.given("--layers") && line.given("--height"))
        refuse("--layers and --height exclude each other");
    if (s.mode == pieces && !placed && !s.bed) refuse("pieces: where? give --bed or --height");
    if (s.bed && (placed || line.given("--normal")))
        refuse("--bed chooses the planes: not with --normal, --at or --height");
    if (s.bed && std::min({s.bed->x, s.bed->y, s.bed->z}) <= 0.0)
        refuse("--bed: sizes above 0 are needed");
}

void check_request(const command_line& line, cut_settings& s, common_options& options) {
    check_mode(line, s);
    if (s.mode == cut_mode::info) return;
    if (s.mode == cut_mode::section) {
        const std::string format = tools::extension_of(s.output);
        if (!s.output.empty() && format != "svg" && format != "dxf" && format != "obj" &&
            format != "json")
            refuse(s.output.string() + ": sections can be written as svg, dxf, obj or json");
    } else {
        options.output = s.output;
        tools::check_common_options(line, options);
        const bool single = (s.mode == cut_mode::half && s.keep != tools::kept_half::both) ||
                            s.mode > cut_mode::info;
        if (!single) {
            if (!options.output_dir.empty() || options.in_place)
                refuse("--output-dir and --in-place need --keep below or above");
            tools::check_pieces_path(options, s.largest == 1 ? 1 : 2);
        }
        if (!s.caps.empty() && !options.output.empty()) {
            const std::string format = tools::mesh_format(options, options.output);
            if (format != "ply" && format != "glb")
                refuse("--caps needs an output with properties: ply, glb");
        }
    }
    tools::require_output(line, options);
}

/// What `make` returns; where its arguments do not suit the mesh, the option is to blame.
template <class Make>
auto suitable(const char* option, const Make& make) {
    try {
        return make();
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        refuse(std::string(option) + text.substr(std::min(text.size(), text.find(": "))));
    }
}

exit_status make_section(tools::job& work, const usable_input& input, cut_settings s) {
    if (s.layers > 0.0) {
        s.heights = suitable(
            "--layers", [&] { return s.plane.layer_heights(input.file.mesh.points, s.layers); });
        work.entry["planes"]["heights"] = s.heights;
    }
    tf::section_result made;
    {
        const auto timing = work.time("cut");
        made = tf::section(input.file.mesh, s.plane, s.heights, {work.progress("section")});
    }
    work.call_ended(made.status == tf::status::cancelled);
    tools::say_section(work, s, input, made);
    tools::write_page(work, input, "section", true, {}, &made);
    if (s.output.empty() || work.options.dry_run) return tools::done;
    const auto timing = work.time("write");
    tools::output_place place(s.output, work.options.force);
    tf::write_section(place.writable(), made, tools::extension_of(s.output));
    place.commit();
    work.entry["output"] = {{"file", s.output.string()},
                            {"format", tools::extension_of(s.output)},
                            {"precision_out", nullptr},
                            {"max_move", nullptr}};
    return tools::done;
}

std::vector<cut_off> parts_of(const usable_input& input, const cut_settings& s) {
    tf::components_options options{.min_volume = s.min_volume};
    if (s.largest > 0) options.largest = s.largest;
    std::vector<cut_off> parts;
    for (tf::mesh_part& part : tf::components(input.file.mesh, options)) {
        cut_off& one = parts.emplace_back();
        one.mesh = std::move(part.mesh);
        one.face_source = std::move(part.face_source);
        one.vertex_source = std::move(part.vertex_source);
        one.volume = tools::volume_of(one.mesh);
        one.area = part.area;
        one.certificate.precision = input.file.stored_as;
    }
    return parts;
}

std::vector<cut_off> pieces_of(tf::cut_result&& made, const cut_settings& s) {
    std::vector<cut_off> pieces;
    for (std::size_t i = 0; i < made.pieces.size(); ++i) {
        if (s.mode == cut_mode::half && s.keep != tools::kept_half::both &&
            (i == 0) != (s.keep == tools::kept_half::below))
            continue;
        tf::cut_piece& piece = made.pieces[i];
        if (piece.mesh.faces.empty()) continue;
        cut_off& one = pieces.emplace_back();
        one.volume = s.open ? tools::volume_of(piece.mesh) : tf::signed_volume(piece.mesh);
        one.area = tf::surface_area(piece.mesh);
        one.mesh = std::move(piece.mesh);
        one.face_source = std::move(piece.face_source);
        one.vertex_source = std::move(piece.vertex_source);
        one.cap = std::move(piece.cap);
        one.certificate = std::move(piece.certificate);
    }
    return pieces;
}

/// Of the coordinates written.
tf::precision precision_of(tools::job& work, const usable_input& input) {
    std::optional<tools::written_form> form;
    if (const auto output = tools::mesh_output(work.options, work.path))
        form = tools::form_of(work, input.file, *output);
    const tf::mesh_file* const files = &input.file;
    return tools::written_precision(work.options, form, {&files, 1});
}

tf::cut_result cut(tools::job& work, const usable_input& input, const cut_settings& s) {
    const auto timing = work.time("cut");
    const tf::carry_source source = input.source();
    const tf::cut_options options{.precision = precision_of(work, input),
                                  .caps = !s.open,
                                  .keep_cuts = tf::carry_sources(source).merging_mixes_values(),
                                  .progress = work.progress("cut")};
    tf::cut_result made = suitable(s.bed ? "--bed" : "--height", [&] {
        return s.bed ? tf::cut_to_fit(input.file.mesh, *s.bed, options)
                     : tf::cut(input.file.mesh, s.plane, s.heights, options);
    });
    work.call_ended(made.certificate.status == tf::status::cancelled);
    return made;
}

exit_status not_made(tools::job& work, const usable_input& input, const tf::certificate& why) {
    work.out.result(work.name + ": not made: " + tools::message_of(why, [&](std::uint32_t f) {
                        return input.source().stored_face(f);
                    }));
    if (why.status == tf::status::open_input)
        work.warn("no-solid",
                  "the input bounds no solid; tf-repair makes one of it, and thicken takes any "
                  "surface");
    return tools::found;
}

exit_status look_at(tools::job& work, const cut_settings& s) {
    tools::check_outputs(work, {}, {s.output});
    const usable_input input = tools::read_usable(work);
    tools::enter_blank_report(work, s, input);
    if (s.mode == cut_mode::section) return make_section(work, input, s);
    if (s.mode == cut_mode::info) {
        tools::say_info(work, input);
        tools::write_page(work, input, "info", true, {}, nullptr);
        return tools::done;
    }
    std::vector<cut_off> pieces;
    if (s.mode == cut_mode::parts) {
        const auto timing = work.time("cut");
        pieces = parts_of(input, s);
    } else if (s.mode > cut_mode::info) {
        pieces.push_back(suitable(option_of(s.mode), [&] {
            return tools::shape_of(work, s, input, precision_of(work, input));
        }));
        if (!pieces[0].certificate) return not_made(work, input, pieces[0].certificate);
    } else {
        tf::cut_result made = cut(work, input, s);
        if (!made.certificate) {
            const std::string why = tools::message_of(
                made.certificate, [&](std::uint32_t f) { return input.source().stored_face(f); });
            work.out.result(work.name + ": not cut: " + why);
            if (made.certificate.status == tf::status::open_input)
                work.warn("no-solid",
                          "the input bounds no solid; tf-repair makes one of it, and "
                          "--open cuts it as a surface");
            tools::write_page(work, input, "not cut: " + why, false, {}, nullptr);
            return tools::found;
        }
        pieces = pieces_of(std::move(made), s);
        const auto furthest = std::ranges::max_element(
            pieces, {}, [](const cut_off& piece) { return piece.certificate.max_displacement; });
        if (furthest != pieces.end()) {
            const std::string too_far =
                tools::move_objection(work.entry, s.limits, tools::diagonal_of(input),
                                      furthest->certificate, furthest->mesh.points);
            if (!too_far.empty()) {
                work.out.result(work.name + ": not written: " + too_far);
                return tools::found;
            }
            tools::warn_of_moves(work, furthest->mesh.points, furthest->certificate);
        }
    }
    tools::say_pieces(work, s, input, pieces);
    tools::write_page(work, input, s.mode_text, true, pieces, nullptr);
    if (!pieces.empty()) tools::write_pieces(work, s, input, pieces);
    return tools::done;
}

}  // namespace

int main(int argc, char** argv) {
    command_line line("tf-cut", "MODE [OPTIONS] INPUT...",
                      "Cut meshes by planes: sections, halves, pieces for a printer; take their\n"
                      "parts, and say what they are. Every verdict is exact.");
    cut_settings s;
    common_options options;
    options.suffix = "-cut";
    options.table = {{"faces", "/faces"},
                     {"solid", "/info/solid", false},
                     {"components", "/info/components"},
                     {"area", "/info/area"},
                     {"volume", "/info/volume"}};
    line.word("MODE", [&](std::string_view text) { s.mode_text = text; });
    line.inputs(options.inputs, tools::mesh_inputs);
    add_modes(line);
    add_options(line, s);
    add_what_to_give_back(line, s);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf"}});
    line.offer("--output", {"ply", "obj", "stl", "off", "glb", "3mf", "svg", "dxf", "json"});
    line.epilogue(epilogue);
    return tools::run(
        line, options, {"read", "prepare", "check", "cut", "write"}, argc, argv,
        [&] { check_request(line, s, options); },
        [&](tools::job& work) { return look_at(work, s); });
}
