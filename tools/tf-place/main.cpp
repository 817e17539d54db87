/// \file
/// tf-place: finds where to put one mesh with respect to others.

#include "tools/common/command_line.hpp"
#include "tools/common/common_options.hpp"
#include "tools/common/console.hpp"
#include "tools/common/run.hpp"
#include "tools/tf-place/move.hpp"
#include "tools/tf-place/outputs.hpp"
#include "tools/tf-place/plate.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/tf.hpp>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace {

using tools::command_line;
using tools::common_options;
using tools::exit_status;
using tools::place_mode;
using tools::place_settings;

void add_modes(command_line& line) {
    line.group("Modes");
    line.mention({.names = "drop",
                  .text = "translate down until MOVING rests on the bed or on\n--fixed; from below "
                          "the bed, up to it, if there is no\n--fixed"});
    line.mention({.names = "lay", .text = "turn a flat side down, on the bed"});
    line.mention({.names = "slide",
                  .text = "translate along --direction until contact (less\n--clearance)"});
    line.mention(
        {.names = "mate", .text = "bring the closest points of MOVING and --fixed\ntogether"});
    line.mention({.names = "clear, separate",
                  .text = "out of --fixed, or away from it to --clearance: a\n"
                          "short translation, the shortest of many tried"});
    line.mention({.names = "arrange, pack",
                  .text = "put all MOVING on the bed or in a box without overlap"});
    line.mention({.names = "fit, align", .text = "align by ICP from the present position"});
    line.mention(
        {.names = "measure", .text = "move nothing; report distance, contact or\npenetration"});
}

void add_lay_options(command_line& line, place_settings& s) {
    line.repeatable_flag(s.sides_chosen, {"--largest-face", "",
                                          "lay: on the largest side of the convex hull", "this"});
    line.option({"--face-normal", "X,Y,Z", "lay: on the side whose normal is nearest to this"},
                [&s](std::string_view text) {
                    s.lay.choose = tf::lay_choice::nearest_normal;
                    s.lay.toward = tools::parse_direction("--face-normal", text);
                    ++s.sides_chosen;
                });
    line.option({"--face-point", "X,Y,Z", "lay: on the side that holds this point"},
                [&s](std::string_view text) {
                    const auto v = tools::parse_numbers("--face-point", text, 3);
                    s.lay.choose = tf::lay_choice::holding_point;
                    s.lay.toward = {v[0], v[1], v[2]};
                    ++s.sides_chosen;
                });
    line.option({"-t, --tolerance", "DIST",
                 "lay: what is this near to the plane of a side is on\n"
                 "it, and flat afterwards; 0 = exactly in one plane",
                 "0.0001%"},
                [&s](std::string_view text) {
                    s.flatness = tools::parse_distance("--tolerance", text);
                    s.flatness_given = true;
                });
    line.flag(s.lay.keep_spin, {"--keep-spin", "", "lay: keep the turn about the vertical"});
}

void add_arrange_and_fit_options(command_line& line, place_settings& s) {
    line.option({"--size", "X,Y[,Z]", "arrange: bed or box size"}, [&s](std::string_view text) {
        s.arrange.size = tools::parse_size3(text);
        s.size_given = s.arrange_options_given = true;
    });
    line.option({"--spacing", "DIST", "arrange: between parts", "2"}, [&s](std::string_view text) {
        const tools::distance spacing = tools::parse_distance("--spacing", text);
        if (spacing.relative)
            throw tools::failure(tools::bad_usage, "usage", "--spacing: expected a length");
        s.arrange.spacing = spacing.value;
        s.arrange_options_given = true;
    });
    line.option({"--rotate", "SET", "arrange: none | 90 | 45 | any", "90"},
                [&s](std::string_view text) {
                    s.arrange.turns = tools::parse_turns(text);
                    s.arrange_options_given = true;
                });
    line.option({"--seed", "N", "arrange: same N, same result", "0"}, [&s](std::string_view text) {
        s.arrange.seed = tools::parse_count("--seed", text);
        s.arrange_options_given = true;
    });
    line.option({"--max-distance", "DIST", "fit: ignore pairs further apart"},
                [&s](std::string_view text) {
                    s.max_distance = tools::parse_distance("--max-distance", text);
                    s.fit_options_given = true;
                });
    line.option({"--overlap", "F", "fit: share of MOVING that has a partner", "1"},
                [&s](std::string_view text) {
                    s.fit.overlap = tools::parse_number("--overlap", text);
                    if (!(s.fit.overlap > 0.0 && s.fit.overlap <= 1.0))
                        throw tools::failure(
                            tools::bad_usage, "usage",
                            "--overlap " + std::string(text) + ": expected a share up to 1");
                    s.fit_options_given = true;
                });
    line.flag(s.fit.scale, {"--scale", "", "fit: allow uniform scale"});
}

void add_options(command_line& line, place_settings& s, common_options& options) {
    line.group("Options");
    line.repeatable_option(options.also_read, {"--fixed", "FILE",
                                               "what stays where it is (repeatable); its objects,\n"
                                               "groups or nodes are bodies, except for what has\n"
                                               "points in common"});
    line.option({"--bed", "Z",
                 "drop, lay, arrange: height of the bed; drop with\n"
                 "--fixed has none unless this is given",
                 "0"},
                [&s](std::string_view text) { s.bed = tools::parse_number("--bed", text); });
    line.option(
        {"-d, --direction", "X,Y,Z", "slide, drop: direction of travel", "0,0,-1"},
        [&s](std::string_view text) { s.direction = tools::parse_direction("--direction", text); });
    line.option({"--clearance", "DIST", "gap to leave", "0"}, [&s](std::string_view text) {
        s.clearance = tools::parse_distance("--clearance", text);
    });
    line.option({"--max-travel", "DIST", "give up beyond this travel (exit 1)"},
                [&s](std::string_view text) {
                    s.max_travel = tools::parse_distance("--max-travel", text);
                });
    add_lay_options(line, s);
    add_arrange_and_fit_options(line, s);
    line.option({"--start", "FILE", "4x4 matrix applied to MOVING first"},
                [&s](std::string_view text) { s.start = text; });
}

void add_what_to_give_back(command_line& line, place_settings& s, common_options& options) {
    line.group("What to give back");
    line.output(options.output, {"-o, --output", "FILE",
                                 "MOVING at its new place; of measure, where it is;\n"
                                 "PLY, GLB: faces that penetrate --fixed are red,\n"
                                 "touching yellow, closer than --clearance or\n"
                                 "stopped at it cyan (if they had no colors)"});
    line.flag(s.scene, {"--scene", "",
                        "-o and --output-dir: the fixed meshes too, with\n"
                        "the names of their parts"});
    line.output(s.matrix, {"--matrix", "FILE",
                           "4x4 matrix, 4 lines, row-major, column vectors:\n"
                           "new = M * old, in file coordinates; \"-\" = stdout"});
}

const char* const epilogue =
    "DIST is in the unit of the file; \"0.01%\" is that share of the diagonal of\n"
    "MOVING's box. Contact is found exactly on the coordinates as read. MOVING is\n"
    "then looked at again, exactly, in the coordinates that are written, and moved\n"
    "back by units in their last place where rounding made it penetrate. A clearance\n"
    "holds for distances as computed, to their rounding error.\n"
    "\n"
    "What penetrates at the start is moved by clear alone; what touches stays.\n"
    "Only closed meshes have an inside. Resting on the bed, the lowest points have\n"
    "exactly its height (a float32 that is not below it, where these are written).\n"
    "Where coordinates are coarser at the place than they were, faces are looked at\n"
    "again; a warning, and \"rounding\" in the report, say what moved and what folds.\n"
    "Several MOVING are placed each on its own; by arrange, together: then -o is the\n"
    "plate, and --matrix has 4 lines for each. Face numbers are those of the\n"
    "files, from 0; of a cloud of points they are those of its points. Clouds bound\n"
    "nothing: they penetrate where a point is inside a closed mesh.\n"
    "\n"
    "Examples:\n"
    "  tf-place drop part.stl -o on_bed.stl --matrix m.txt\n"
    "  tf-place slide crown.stl --fixed jaw.stl -d 0,0,-1 --clearance 0.03 -o s.stl\n"
    "  tf-place clear a.obj --fixed b.obj --fixed c.obj --clearance 1 -o a_moved.obj\n"
    "  tf-place measure a.stl --fixed b.stl -r -\n"
    "\n"
    "Exit status: 0 placed, or measured; 1 no such place (no contact, penetrating at\n"
    "  the start, not all fit, not converged); 2 usage; 3 input; 4 output;\n"
    "  5 stopped (memory, timeout, signal); 70 bug. Of several inputs, the highest.\n";

/// Options that would do nothing are refused rather than passed over.
void check_settings(const command_line& line, place_settings& s, common_options& o) {
    s.mode = tools::parse_mode(s.mode_text);
    s.fixed = o.also_read;
    if (!s.start.empty()) o.also_read.push_back(s.start.string());
    const std::string& mode = s.mode_text;
    const bool lays = s.mode == place_mode::lay, arranges = s.mode == place_mode::arrange;
    const bool fits = s.mode == place_mode::fit, measures = s.mode == place_mode::measure;
    const bool on_bed = s.mode == place_mode::drop || lays || arranges;
    const bool clearance = s.clearance.value > 0.0, mesh = tools::wants_mesh(o);
    const bool form = o.ascii || o.binary || o.precision != "keep" || !o.output_format.empty();
    const std::initializer_list<std::pair<bool, std::string>> refused{
        {!lays && (s.sides_chosen > 0 || s.lay.keep_spin || s.flatness_given),
         "--largest-face, --face-normal, --face-point, --tolerance and --keep-spin are for lay"},
        {lays && s.sides_chosen > 1,
         "--largest-face, --face-normal and --face-point exclude each other"},
        {lays && !s.fixed.empty(), "--fixed: lay puts MOVING on the bed alone"},
        {lays && clearance, "--clearance: lay puts MOVING on the bed"},
        {lays && s.max_travel, "--max-travel: lay goes to the bed"},
        {!arranges && s.arrange_options_given,
         "--size, --spacing, --rotate and --seed are for arrange"},
        {!fits && (s.fit_options_given || s.fit.scale),
         "--max-distance, --overlap and --scale are for fit"},
        {arranges && !s.size_given, "arrange needs --size"},
        {arranges && !s.fixed.empty(), "--fixed: arrange puts MOVING on an empty plate"},
        {fits && s.fixed.size() > 1, "fit: one --fixed only"},
        {(arranges || fits) && (clearance || s.max_travel),
         "--clearance and --max-travel are not for " + mode},
        {s.fixed.empty() && !on_bed, mode + " needs --fixed"},
        {s.bed && !on_bed, "--bed: only drop, lay and arrange have one"},
        {s.direction && !s.moves_along_direction(), "--direction: " + mode + " finds its own"},
        {s.has_bed() && s.direction && !(s.direction->z < 0.0),
         "--direction: does not lead down to the bed"},
        {measures && s.max_travel, "--max-travel: measure moves nothing"},
        {measures && !s.matrix.empty(), "--matrix: measure moves nothing"},
        {measures && o.in_place, "--in-place: measure moves nothing"},
        {s.scene && (!mesh || o.in_place), "--scene needs -o or --output-dir"},
        {!mesh && form,
         "--output-format, --ascii, --binary and --precision need -o, --output-dir or --in-place"}};
    for (const auto& [broken, text] : refused)
        if (broken) throw tools::failure(tools::bad_usage, "usage", text);
    if (!measures) tools::require_output(line, o);
}

exit_status look_at(tools::job& work, const place_settings& s, tools::body_set& fixed) {
    tools::enter_blank_report(work, s);
    tools::check_outputs(work, s);
    const tf::transform<3> start =
        s.start.empty() ? tf::transform<3>{} : tools::read_matrix(s.start);
    tools::body_set moving;
    static_cast<void>(tools::read_body(work, work.path, start, moving));
    const tools::body& one = moving.bodies[0];
    const tf::precision precision = tools::precision_of(work, *one.file);
    tools::read_fixed(work, s, s.scene && precision == tf::precision::float32, fixed);
    tools::enter_bodies(work, one, fixed);

    const tools::outcome found = tools::place(work, moving, fixed, s, precision);
    const tf::transform<3> matrix = tf::after(found.at.matrix, start);
    work.out.result(work.name + ": " + tools::verdict(one, found, fixed, s));
    tools::say_details(work, found, fixed);
    tools::enter_report(work, one, found, fixed, s, matrix);
    if (!found.at) return tools::found;
    const auto timing = work.time("write");
    if (!s.matrix.empty()) tools::write_matrix(work, s.matrix, tools::matrix_text(matrix));
    tools::write_result(work, moving, found, fixed, s, matrix);
    return found.complete() ? tools::done : tools::found;
}

}  // namespace

int main(int argc, char** argv) {
    command_line line("tf-place", "MODE [OPTIONS] MOVING...",
                      "Find where to put one mesh (or point set) with respect to others.\n"
                      "The result never penetrates: it is checked again in the precision written.");
    place_settings s;
    tools::body_set fixed;
    common_options options;
    options.suffix = "-place";
    line.word("MODE", [&](std::string_view text) {
        s.mode_text = text;
        options.joined = text == "arrange" || text == "pack";  // they go to one plate
    });
    line.inputs(options.inputs,
                "meshes: STL OBJ PLY OFF GLB/glTF 3MF; points: PLY\n"
                "PCD XYZ CSV; \"-\" = stdin",
                "MOVING");
    add_modes(line);
    add_options(line, s, options);
    add_what_to_give_back(line, s, options);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "obj", "stl", "off", "glb", "xyz"}});
    line.refuse("--html", true, "makes no sense here; measure -o file.ply shows the faces");
    line.epilogue(epilogue);
    return tools::run(
        line, options, {"read", "prepare", "search", "settle", "write"}, argc, argv,
        [&] { check_settings(line, s, options); },
        [&](tools::job& work) {
            return s.mode == place_mode::arrange ? tools::arrange_all(work, s)
                                                 : look_at(work, s, fixed);
        });
}
