#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/tf-cut/cutting.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tools {
namespace {

const std::vector<std::string> of_planes{"--normal", "--at", "--height"};
const std::vector<std::string> of_one{"--in-place", "--output-dir", "--suffix"};
const std::vector<std::string> of_meshes{"--output-format", "--precision", "--ascii", "--binary"};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

void add_shape_modes(command_line& line) {
    const std::vector<std::string> without = both(of_planes, {"--max-move"});
    line.mode(
        {.names = "simplify",
         .text = "fewer faces, both surfaces within a distance, proven",
         .usage = "simplify --distance D [OPTIONS] INPUT...",
         .more = "No faces are made to meet. Borders and seams, also of materials and\n"
                 "values, are kept; values of vertices and corners are interpolated.\n\nExamples:\n"
                 "  $ tf-cut simplify data/sphere.ply --distance 0.01 -o fewer.ply\n"
                 "  data/sphere.ply: 1 piece: 448 faces, volume 4.12737, at most 0.00999988 away\n",
         .without = without});
    line.mode(
        {.names = "offset",
         .text = "the solid grown by a distance, or shrunk by -D",
         .usage = "offset --distance D [OPTIONS] INPUT...",
         .more =
             "Prints between which distances from the input all of the result is.\n\nExamples:\n"
             "  $ tf-cut offset data/cube.stl --distance 0.25 --resolution 0.1 -o "
             "grown.stl\n"
             "  data/cube.stl: 1 piece: 9,000 faces, volume 3.1403, 0.237246 to "
             "0.254951 away\n",
         .without = without});
    line.mode(
        {.names = "hollow",
         .text = "the solid with cavities, its surface as it is",
         .usage = "hollow --wall W [OPTIONS] INPUT...",
         .more = "Holes are drilled by --drain. A warning names those that lead nowhere, and says\n"
                 "how many cavities none leads into.\n\nExamples:\n"
                 "  $ tf-cut hollow data/cube.stl --wall 0.1 --resolution 0.05 -o shell.stl\n"
                 "  data/cube.stl: 1 piece: 11,916 faces, volume 0.493755, 0.0999512 to "
                 "0.125078 away\n",
         .without = without});
    line.mode({.names = "thicken",
               .text = "a solid around a surface, which may be open",
               .usage = "thicken --thickness T [OPTIONS] INPUT...",
               .more = "Its rim is round.\n\nExamples:\n"
                       "  $ tf-cut thicken data/cube.stl --thickness 0.2 --resolution 0.05 -o "
                       "solid.stl\n"
                       "  data/cube.stl: 1 piece: 36,744 faces, volume 1.18758, 0.0923752 to "
                       "0.12508 away\n",
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
    line.mode({.names = "isolines",
               .text = "lines where a value has levels; written like sections",
               .usage = "isolines --levels L[,L...] [OPTIONS] INPUT...",
               .more = "Prints how many levels and lines there are, and their length. Lines end\n"
                       "where the mesh does. SVG has them as seen along --normal, the other\n"
                       "formats in space.\n\nExamples:\n"
                       "  $ tf-cut isolines data/sphere.ply --count 3 -o lines.svg\n"
                       "  data/sphere.ply: 3 levels, 3 lines, length 17.1219\n",
               .without = both(both(of_meshes, of_one), {"--max-move", "--height"})});
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
               .text = "size, solid or why not, volume, center, thinnest wall",
               .usage = "info [OPTIONS] INPUT...",
               .more =
                   "Of many inputs, prints a table at the end.\n\nExamples:\n"
                   "  $ tf-cut info data/cube.stl\n"
                   "  data/cube.stl: 12 faces, 1 x 1 x 1, solid; 1 component, area 6, volume 1, "
                   "center (0.5, 0.5, 0.5), thinnest wall 1 at (0.333333, 0.333333, 0)\n",
               .without = both(both(both(of_planes, of_meshes), of_one),
                               {"--output", "--dry-run", "--max-move"})});
    add_shape_modes(line);
}

void add_distances(command_line& line, shape_settings& s) {
    line.group("Distances");
    line.option({"--distance", "D",
                 "simplify, offset: how far both surfaces may be apart;\n"
                 "or how far the solid grows (below 0: shrinks)"},
                [&s](std::string_view v) {
                    const bool shrinks = v.starts_with('-');
                    s.distance = parse_distance("--distance", v.substr(shrinks ? 1 : 0));
                    if (!shrinks) return;
                    s.distance.value = -s.distance.value;
                    s.distance.given.insert(0, "-");
                });
    line.option({"--wall", "W", "hollow: how thick the wall is"},
                [&s](std::string_view v) { s.distance = parse_distance("--wall", v); });
    line.option({"--thickness", "T", "thicken: how thick the solid is"},
                [&s](std::string_view v) { s.distance = parse_distance("--thickness", v); });
    line.option({"--resolution", "R",
                 "offset, hollow, thicken: edge of the cells that the\n"
                 "surface is made in, at most half of the distance;\n"
                 "a quarter, or what some 170,000 faces allow"},
                [&s](std::string_view v) { s.resolution = parse_number("--resolution", v); });
    line.option(s.side, {"--side", "SIDE", "thicken: both | front | back", "both"}, thick_sides);
    line.option({"--drain", "X,Y,Z,D",
                 "hollow: a hole of this diameter at the nearest point;\n"
                 "may be repeated"},
                [&s](std::string_view v) {
                    const auto n = parse_numbers("--drain", v, 4);
                    s.drains.push_back({{n[0], n[1], n[2]}, n[3]});
                });
    line.option(s.fewest_faces, {"--faces", "N", "simplify: stop at this many faces", "0"});
}

void add_options(command_line& line, cut_settings& s) {
    line.group("Planes");
    line.option({"--normal", "X,Y,Z", "across the plane; above is where it points", "0,0,1"},
                [&s](std::string_view v) { s.plane.normal = parse_direction("--normal", v); });
    line.option({"--at", "X,Y,Z", "a point of the plane", "0,0,0"},
                [&s](std::string_view v) { s.plane.at = parse_point("--at", v); });
    line.option({"--height", "H,...", "planes at these heights above --at", "0"},
                [&s](std::string_view v) {
                    const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
                    s.heights = parse_numbers("--height", v, count);
                });
    line.option({"--layers", "T",
                 "section: planes in the middles of layers of this\n"
                 "thickness, from the lowest point to the highest"},
                [&s](std::string_view v) { s.layers = parse_number("--layers", v); });
    line.option(s.lines.value, {"--value", "NAME",
                                "isolines: the value: height above --at; distance\n"
                                "from --to, below 0 inside a closed mesh; or a\n"
                                "property of vertices: red, quality, ...",
                                "height"});
    line.option({"--to", "MESH", "isolines: the mesh that distance is measured from"},
                [&s](std::string_view v) { s.lines.to = v; });
    line.option({"--levels", "L,...", "isolines: levels of the value"}, [&s](std::string_view v) {
        const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
        s.lines.levels = parse_numbers("--levels", v, count);
    });
    line.option(s.lines.count, {"--count", "N",
                                "isolines: this many levels, evenly spaced between\n"
                                "the least value and the greatest",
                                "0"});
    line.option({"--bed", "X,Y[,Z]",
                 "pieces: that fit into a box of this size; as few as\n"
                 "possible, of equal length"},
                [&s](std::string_view v) {
                    const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
                    const auto size = parse_numbers("--bed", v, count == 2 ? 2 : 3);
                    s.bed = {size[0], size[1],
                             count == 2 ? std::numeric_limits<double>::infinity() : size[2]};
                });
    add_distances(line, s.shape);
    line.group("Options");
    line.option(s.keep, {"--keep", "HALF", "half: both | below | above", "both"}, kept_halves);
    line.flag(s.open, {"--open", "",
                       "half, pieces: cut a surface, which may end anywhere,\n"
                       "and leave the pieces open"});
    line.option(s.walls,
                {"--walls", "HOW",
                 "info: thinnest wall of a solid: ray, from the middle\n"
                 "of each face inward; sphere, the largest ball there\n"
                 "(it takes far longer); or none",
                 "ray"},
                wall_measures);
    add_max_move(line, s.limits);
    line.option({"--min-volume", "V", "parts: leave out those below V; open ones have none", "0"},
                [&s](std::string_view v) { s.parts.min_volume = parse_volume("--min-volume", v); });
    line.option(s.parts.largest,
                {"--largest", "N", "parts: only the N of the greatest volume", "all"});
}

void add_what_to_give_back(command_line& line, cut_settings& s) {
    line.group("What to give back");
    line.output(s.output, {"-o, --output", "FILE",
                           "where the result goes: lines as svg, dxf, obj or json,\n"
                           "\"-\" being json on standard output;\n"
                           "pieces as meshes, or objects of one 3MF, OBJ or GLB.\n"
                           "\"%d\" in the name, or \"%03d\" with zeros ahead, is the\n"
                           "number of a layer or piece with a file of its own"});
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

void check_lines(const command_line& line, line_settings& lines) {
    constexpr std::uint64_t most_levels = 100'000;
    if (!line.given("--levels") && !line.given("--count"))
        refuse("isolines: where? give --levels or --count");
    if (lines.count > most_levels || (line.given("--count") && lines.count == 0))
        refuse("--count: from 1 to 100,000");
    if (!lines.to.empty() && line.given("--value") && lines.value != "distance")
        refuse("--to is for --value distance");
    if (!lines.to.empty()) lines.value = "distance";
    if (lines.to.empty() && lines.value == "distance") refuse("--value distance needs --to");
}

void check_mode(const command_line& line, cut_settings& s) {
    const auto at = std::ranges::find(cut_modes, s.mode_text);
    if (at == cut_modes.end())
        refuse(s.mode_text + ": no mode; expected one of " + listed(cut_modes));
    s.mode = static_cast<cut_mode>(at - cut_modes.begin());
    const auto only = [&](const char* name, std::initializer_list<cut_mode> modes) {
        if (line.given(name) && std::ranges::find(modes, s.mode) == modes.end())
            refuse(std::string(name) + " is not for " + s.mode_text);
    };
    using enum cut_mode;
    for (const char* name : {"--normal", "--at"}) only(name, {half, section, isolines, pieces});
    only("--height", {half, section, pieces});
    for (const char* name : {"--value", "--to", "--levels", "--count"}) only(name, {isolines});
    for (const char* name : {"--open", "--caps", "--max-move"}) only(name, {half, pieces});
    for (const char* name : {"--min-volume", "--largest"}) only(name, {parts});
    only("--layers", {section});
    only("--bed", {pieces});
    only("--walls", {info});
    only("--keep", {half});
    for (const char* name : {"--output", "--dry-run"})
        only(name, {half, section, isolines, pieces, parts, simplify, offset, hollow, thicken});
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
    if (s.mode == isolines) check_lines(line, s.lines);
    if (line.given("--layers") && line.given("--height"))
        refuse("--layers and --height exclude each other");
    if (s.mode == pieces && !placed && !s.bed) refuse("pieces: where? give --bed or --height");
    if (s.bed && (placed || line.given("--normal")))
        refuse("--bed chooses the planes: not with --normal, --at or --height");
    if (s.bed && std::min({s.bed->x, s.bed->y, s.bed->z}) <= 0.0)
        refuse("--bed: sizes above 0 are needed");
}

}  // namespace

const char* option_of(cut_mode mode) {
    return mode == cut_mode::hollow    ? "--wall"
           : mode == cut_mode::thicken ? "--thickness"
                                       : "--distance";
}

void add_settings(command_line& line, cut_settings& s) {
    add_modes(line);
    add_options(line, s);
    add_what_to_give_back(line, s);
    line.epilogue(epilogue);
}

void check_request(const command_line& line, cut_settings& s, common_options& options) {
    check_mode(line, s);
    if (s.mode == cut_mode::info) return;
    if (s.mode == cut_mode::section || s.mode == cut_mode::isolines) {
        const std::string format = lines_format(s.output);
        if (s.mode == cut_mode::isolines && has_number(s.output))
            refuse(s.output.string() + ": isolines are one file; \"%d\" is for layers and pieces");
        if (!s.output.empty() && format != "svg" && format != "dxf" && format != "obj" &&
            format != "json")
            refuse(s.output.string() +
                   ": sections and isolines can be written as svg, dxf, obj or json");
    } else {
        options.output = s.output;
        check_common_options(line, options);
        const bool single = s.keeps_one() || s.mode > cut_mode::info;
        if (!single) {
            if (!options.output_dir.empty() || options.in_place)
                refuse("--output-dir and --in-place need --keep below or above");
            check_pieces_path(options, s.parts.largest == 1 ? 1 : 2);
        }
        if (!s.caps.empty() && !options.output.empty()) {
            const std::string format = mesh_format(options, options.output);
            if (format != "ply" && format != "glb")
                refuse("--caps needs an output with properties: ply, glb");
        }
    }
    require_output(line, options);
}

}  // namespace tools
