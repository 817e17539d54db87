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
                 "simplify, offset: distance of the result from the\n"
                 "input; simplify stays within D; offset grows the solid\n"
                 "by D, or shrinks it if D is negative"},
                [&s](std::string_view v) {
                    const bool shrinks = v.starts_with('-');
                    s.distance = parse_distance("--distance", v.substr(shrinks ? 1 : 0));
                    if (!shrinks) return;
                    s.distance.value = -s.distance.value;
                    s.distance.given.insert(0, "-");
                });
    line.option({"--wall", "W", "hollow: thickness of the wall"},
                [&s](std::string_view v) { s.distance = parse_distance("--wall", v); });
    line.option({"--thickness", "T", "thicken: thickness of the solid"},
                [&s](std::string_view v) { s.distance = parse_distance("--thickness", v); });
    line.option({"--resolution", "R",
                 "offset, hollow, thicken: cell size, at most half of\n"
                 "the distance; default: a quarter of the distance, or\n"
                 "larger to keep the result below about 170,000 faces"},
                [&s](std::string_view v) { s.resolution = parse_number("--resolution", v); });
    line.option({"--side", "SIDE", "thicken: both | front | back", "both"},
                [&s](std::string_view v) {
                    constexpr std::array shifts{0.0, 0.5, -0.5};
                    s.shift = shifts[parse_choice("--side", v, thick_sides)];
                });
    line.offer("--side", {thick_sides.begin(), thick_sides.end()});
    line.option({"--drain", "X,Y,Z,D",
                 "hollow: a hole of diameter D at the point of the\n"
                 "surface nearest to X,Y,Z (repeatable)"},
                [&s](std::string_view v) {
                    const auto n = parse_numbers("--drain", v, 4);
                    s.drains.push_back({{n[0], n[1], n[2]}, n[3]});
                });
    line.option(s.fewest_faces, {"--faces", "N", "simplify: stop at this many faces", "0"});
}

void add_options(command_line& line, cut_settings& s) {
    line.group("Planes");
    line.option({"--normal", "X,Y,Z", "normal of the plane, which points upward", "0,0,1"},
                [&s](std::string_view v) { s.plane.normal = parse_direction("--normal", v); });
    line.option({"--at", "X,Y,Z", "a point of the plane", "0,0,0"},
                [&s](std::string_view v) { s.plane.at = parse_point("--at", v); });
    line.option({"--height", "H,...", "heights of the planes above --at, along --normal", "0"},
                [&s](std::string_view v) {
                    const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
                    s.heights = parse_numbers("--height", v, count);
                });
    line.option({"--layers", "T",
                 "section: one plane in the middle of each layer of this\n"
                 "thickness, from the lowest point to the highest"},
                [&s](std::string_view v) { s.layers = parse_number("--layers", v); });
    line.option(s.lines.value, {"--value", "NAME",
                                "isolines: the value: height (above --at), distance\n"
                                "(from --to, negative inside a closed mesh), or a\n"
                                "property of vertices, such as red or quality",
                                "height"});
    line.option({"--to", "MESH", "isolines: the mesh from which distance is measured"},
                [&s](std::string_view v) { s.lines.to = v; });
    line.option({"--levels", "L,...", "isolines: levels of the value"}, [&s](std::string_view v) {
        const auto count = static_cast<std::size_t>(std::ranges::count(v, ',')) + 1;
        s.lines.levels = parse_numbers("--levels", v, count);
    });
    line.option(s.lines.count, {"--count", "N",
                                "isolines: number of levels, evenly spaced between\n"
                                "the least and the greatest value",
                                "0"});
    line.option({"--bed", "X,Y[,Z]",
                 "pieces: cut into the fewest pieces that fit this size,\n"
                 "equally long along each axis"},
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
                       "half, pieces: cut the mesh as a surface, without caps;\n"
                       "it may be open"});
    line.option(s.walls,
                {"--measure-walls", "HOW",
                 "info: how to find the thinnest wall of a solid: ray,\n"
                 "from the center of each face inward; sphere, by the\n"
                 "largest ball that touches the face from inside (much\n"
                 "slower); or none",
                 "ray"},
                wall_measures);
    add_max_move(line, s.limits);
    line.option({"--min-volume", "V", "parts: drop parts below V; open parts count as 0", "0"},
                [&s](std::string_view v) { s.parts.min_volume = parse_volume("--min-volume", v); });
    line.option(s.parts.largest,
                {"--largest", "N", "parts: only the N parts of greatest volume", "all"});
}

void add_outputs(command_line& line, cut_settings& s) {
    line.group("Output");
    line.output(s.output, {"-o, --output", "FILE",
                           "the result: meshes, or lines as svg, dxf, obj or json\n"
                           "(\"-\": json on standard output); several meshes become\n"
                           "objects of one 3MF, OBJ or GLB. With \"%d\" in the\n"
                           "name, or \"%03d\" for leading zeros, each layer or\n"
                           "piece gets its own file, with its number"});
    line.option(s.caps, {"--caps", "P",
                         "half, pieces: write the plane number of each cap face\n"
                         "to property P of a PLY or GLB; -1 for other faces"});
}

void check_lines(const command_line& line, line_settings& lines) {
    constexpr std::uint64_t most_levels = 100'000;
    if (!line.given("--levels") && !line.given("--count"))
        refuse("isolines needs --levels or --count");
    if (lines.count > most_levels || (line.given("--count") && lines.count == 0))
        refuse("--count: expected 1 to 100000");
    if (!lines.to.empty() && line.given("--value") && lines.value != "distance")
        refuse("--to is for --value distance");
    if (!lines.to.empty()) lines.value = "distance";
    if (lines.to.empty() && lines.value == "distance") refuse("--value distance needs --to");
}

void check_mode(const command_line& line, cut_settings& s) {
    const auto at = std::ranges::find(cut_modes, s.mode_text);
    if (at == cut_modes.end())
        refuse(s.mode_text + ": not a mode; expected one of " + listed(cut_modes));
    s.mode = static_cast<cut_mode>(at - cut_modes.begin());
    line.refuse_others(s.mode_text);
    using enum cut_mode;
    const auto needs = [&](cut_mode mode, const char* name) {
        if (s.mode == mode && !line.given(name)) refuse(s.mode_text + " needs " + name);
    };
    for (const cut_mode mode : {simplify, offset, hollow, thicken}) needs(mode, option_of(mode));
    const bool placed = line.given("--at") || line.given("--height");
    if (s.mode == half && !placed) refuse("half needs --height or --at");
    if (s.mode == half && s.heights.size() > 1)
        refuse("half takes one --height; pieces takes several");
    if (line.given("--layers") && s.layers <= 0.0)
        refuse("--layers: expected a thickness greater than 0");
    if (s.mode == section && !placed && s.layers == 0.0)
        refuse("section needs --height, --at or --layers");
    if (s.mode == isolines) check_lines(line, s.lines);
    if (line.given("--layers") && line.given("--height"))
        refuse("--layers and --height exclude each other");
    if (s.mode == pieces && !placed && !s.bed) refuse("pieces needs --bed or --height");
    if (s.bed && (placed || line.given("--normal")))
        refuse("--bed chooses the planes; it excludes --normal, --at and --height");
    if (s.bed && std::min({s.bed->x, s.bed->y, s.bed->z}) <= 0.0)
        refuse("--bed: expected sizes greater than 0");
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
    add_outputs(line, s);
}

void check_request(const command_line& line, cut_settings& s, common_options& options) {
    check_mode(line, s);
    if (s.mode == cut_mode::info) return;
    if (s.mode == cut_mode::section || s.mode == cut_mode::isolines) {
        const std::string format = lines_format(s.output);
        if (s.mode == cut_mode::isolines && has_number(s.output))
            refuse(s.output.string() +
                   ": isolines are written to one file; \"%d\" is for layers and pieces");
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
            if (s.parts.largest != 1)
                check_pieces_path(options, s.mode == cut_mode::parts ? "parts" : "pieces");
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
