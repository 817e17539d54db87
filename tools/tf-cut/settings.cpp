#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/tf-cut/cutting.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tools {
namespace {

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
    line.refuse_others(s.mode_text);
    using enum cut_mode;
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
    line.group("Modes");
    line.describe(help_text);
    add_options(line, s);
    add_what_to_give_back(line, s);
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
