/// \file
/// tf-weld: merges points or vertices that lie within a distance of each other.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/output_file.hpp"
#include "tools/shell/run.hpp"
#include "tools/shell/tile_options.hpp"
#include "tools/tf-weld/out_of_core.hpp"
#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/settings.hpp"
#include <treeform/tf.hpp>

namespace {

using tools::command_line;
using tools::common_options;
using tools::refuse;
using tools::weld_outputs;
using tools::weld_settings;

void add_what_is_merged(command_line& line, weld_settings& s, bool& exact) {
    line.group("What is merged");
    line.option(s.tolerance,
                {.names = "-t, --tolerance",
                 .value = "DIST",
                 .text = "Euclidean distance, inclusive; 0 = equal\ncoordinates only, lossless",
                 .fallback = "0",
                 .aliases = "--eps,--threshold"});
    line.option({"--rule", "RULE",
                 "first: in file order, drop a point if an earlier\n"
                 "kept one is within DIST\n"
                 "chain: merge all points linked by steps of DIST",
                 "first"},
                [&s](std::string_view text) { tools::parse_rule(text, s.options); });
    line.offer("--rule", {"first", "chain"});
    line.option({"--same", "P[=TOL],...",
                 "merge only points with equal P, or P within TOL, such\n"
                 "as --same classification,nx=0.01"},
                [&s](std::string_view text) { s.options.same = tools::parse_same(text); });
    line.option({"--ignore-seams", "P,...",
                 "merge points across mesh seams in P, which are kept\n"
                 "by default: normal, uv, color"},
                [&s](std::string_view text) {
                    s.options.ignored_seams = tools::parse_ignored_seams(text);
                });
    line.flag(s.options.only_borders,
              {"--borders", "", "merge only vertices on open edges (stitch shells)"});
    line.flag(exact, {.names = "--exact"});
}

void add_which_one_stays(command_line& line, tf::weld_options& options) {
    line.group("Which point of a group is kept");
    line.option({"--keep", "WHICH", "first | last | mean | min:P | max:P", "first"},
                [&options](std::string_view text) { tools::parse_keep(text, options); });
    line.offer("--keep", {"first", "last", "mean", "min:", "max:"});
    line.option({"--order", "P",
                 "P or min:P | max:P: visit points by ascending or\n"
                 "descending P; ties in file order, NaN last",
                 "file order"},
                [&options](std::string_view text) { tools::parse_order(text, options); });
    line.offer("--order", {"min:", "max:"});
}

void add_outputs(command_line& line, weld_outputs& outputs, common_options& options) {
    line.group("Output");
    line.output(options.output, {"-o, --output", "FILE",
                                 "the welded points or mesh, with all their properties\n"
                                 "(meshes: obj ply stl off glb; points: ply pcd\n"
                                 "las laz xyz csv). \"-\" = stdout, with --output-format"});
    line.output(outputs.map, {"--map", "FILE",
                              "input index -> output index: CSV if FILE ends in\n"
                              ".csv or is \"-\", else binary u64, little endian"});
    line.output(outputs.removed, {"--removed", "FILE", "the dropped points, in a point format"});
    line.option(outputs.label, {"--label", "P", "drop nothing; write group numbers to property P"});
    line.flag(outputs.withhold, {"--withhold", "",
                                 "drop nothing; set the flag \"withheld\" of points\n"
                                 "that would be dropped (output in LAS or LAZ)"});
    line.flag(outputs.check, {"--check", "", "only count; exit 1 if points would be merged"});
}

void add_columns(command_line& line, common_options& o, bool& mixed) {
    line.group("Properties");
    line.option({"--columns", "A=B,...",
                 "XYZ, PTS, CSV: property A is the column with heading\n"
                 "B or number B, e.g. x=E,y=N,z=H"},
                [&o](std::string_view text) { o.columns = tools::parse_names("--columns", text); });
    line.flag(o.drop_non_finite,
              {"--drop-non-finite", "", "drop points with a NaN or infinite coordinate first"});
    line.option({"--drop", "P,...",
                 "do not write these properties of points; for normal\n"
                 "and uv, also those of corners"},
                [&o](std::string_view text) { o.drop = tools::parse_properties("--drop", text); });
    line.option({"--rename", "P=NAME,...", "write property P of points as NAME"},
                [&o](std::string_view text) {
                    o.rename = tools::parse_names("--rename", text);
                    for (auto& [name, source] : o.rename) std::swap(name, source);
                });
    line.option({"--las-scale", "S[,S,S]", "scale of LAS coordinates, for all axes or for each",
                 "as in the input, else chosen"},
                [&o](std::string_view text) {
                    o.las_scale = tools::parse_axes("--las-scale", text);
                    for (const double s : *o.las_scale)
                        if (!(s > 0.0))
                            refuse("--las-scale " + std::string(text) +
                                   ": expected numbers greater than 0");
                });
    line.option(
        {"--las-offset", "X[,Y,Z]", "offset of LAS coordinates", "as in the input, else chosen"},
        [&o](std::string_view text) { o.las_offset = tools::parse_axes("--las-offset", text); });
    line.flag(mixed, {"--mixed", "",
                      "--join LAS files even if their reference systems or\n"
                      "time types differ; the output has those of the first"});
}

void add_meshes(command_line& line, weld_settings& s) {
    line.group("Meshes");
    line.flag(s.options.keep_degenerate,
              {"--keep-degenerate", "", "keep collapsed faces", "drop and count them"});
    line.flag(s.options.keep_manifold, {"--keep-manifold", "",
                                        "do not merge two points if that would make an edge of\n"
                                        "more than two faces or a bow-tie vertex"});
}

/// Options that would do nothing are refused rather than passed over.
void check_what_is_marked(const weld_outputs& outputs, const weld_settings& s,
                          const common_options& o) {
    if (!outputs.drops_nothing()) return;
    const std::string option = outputs.withhold ? "--withhold" : "--label";
    if (!tools::wants_mesh(o)) refuse(option + " needs -o, --output-dir or --in-place");
    if (!outputs.removed.empty()) refuse(option + " drops nothing; it excludes --removed");
    if (s.options.keep != tf::weld_keep::first || s.options.keep_degenerate)
        refuse(option + " drops nothing; it excludes --keep and --keep-degenerate");
    if (outputs.withhold && !outputs.label.empty()) refuse("--withhold excludes --label");
    for (const char* axis : {"x", "y", "z"})
        if (outputs.label == axis) refuse("--label " + outputs.label + ": a coordinate");
    if (outputs.label.find_first_of(" \t\r\n,;\"") != std::string::npos)
        refuse("--label " + outputs.label + ": expected a name without blanks and commas");
}

void check_request(const command_line& line, const tools::weld_request& r,
                   const tools::tile_options& tiles, const common_options& o) {
    const bool mesh = tools::wants_mesh(o);
    const weld_outputs& outputs = r.outputs;
    if (outputs.check && (mesh || !outputs.removed.empty()))
        refuse("--check only counts; it excludes -o, --output-dir, --in-place and --removed");
    if (!outputs.check && !tiles.is_part()) tools::require_output(line, o, "--check only counts");
    if (!mesh && !tiles.is_part() && (!o.output_format.empty() || o.precision != "keep"))
        refuse("--output-format and --precision need -o, --output-dir or --in-place");
    if (!mesh && outputs.removed.empty() && (o.ascii || o.binary))
        refuse("--ascii and --binary need an output that they apply to");
    if (!outputs.removed.empty()) tools::check_points_format(outputs.removed);
    if (!mesh && outputs.removed.empty() &&
        (!o.drop.empty() || !o.rename.empty() || o.las_scale || o.las_offset))
        refuse("--drop, --rename, --las-scale and --las-offset need an output that they apply to");
    if (o.drop_non_finite && !outputs.map.empty())
        refuse("--drop-non-finite changes the numbers of points; it excludes --map");
    if (r.mixed && !o.joined) refuse("--mixed needs --join");
    for (const auto& condition : r.settings.options.same)
        for (const auto& name : r.settings.options.ignored_seams)
            if (condition.property == name)
                refuse(name + " is named by --same and by --ignore-seams");
    const tf::weld_options& options = r.settings.options;
    if (!options.order_by.empty() && options.keep != tf::weld_keep::first)
        refuse("--order decides which point is kept; it excludes --keep " +
               tools::keep_in_words(options));
    check_what_is_marked(outputs, r.settings, o);
    tools::check_tile_options(tiles, line, o);
}

int run(int argc, char** argv, tools::team_member& me) {
    command_line line("tf-weld", "[OPTIONS] INPUT...",
                      "Merge points or mesh vertices that are within a distance of each other.\n"
                      "Point clouds stay point clouds; meshes are re-indexed.");
    tools::weld_request r;
    tools::tile_options tiles{.communicator = me.communicator};
    common_options options;
    options.in_team = true;
    options.failed = [&me](const std::string& text) { me.error = text; };
    options.suffix = "-weld";
    options.table = {
        {"points", "/points/in"}, {"kept", "/points/out"}, {"merged", "/points/removed"}};
    bool exact = true;
    line.inputs(options.inputs,
                "points: PLY PCD LAS LAZ XYZ PTS CSV; meshes: STL\n"
                "OBJ PLY OFF GLB/glTF 3MF; or folders; \"-\" = stdin");
    options.takes_points = true;
    line.flag(options.joined, {"--join", "", "treat all INPUTs as one set", "each on its own"});
    add_what_is_merged(line, r.settings, exact);
    add_which_one_stays(line, r.settings.options);
    add_outputs(line, r.outputs, options);
    add_meshes(line, r.settings);
    add_columns(line, options, r.mixed);
    tools::add_tile_options(line, tiles,
                            "Inputs larger than --memory are welded in tiles on the disk",
                            "--tile-points");
    tools::add_sharing_options(line, tiles);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf", "pcd",
                                                  "las", "laz", "xyz", "csv"}});
    line.describe(tools::help_text);
    return tools::run(
        line, options, {"read", "weld", "write"}, argc, argv,
        [&] {
            tools::leave_reports_to_first(tiles, options);
            check_request(line, r, tiles, options);
        },
        [&](tools::job& work) { return tools::weld_somewhere(work, r, tiles); });
}

}  // namespace

int main(int argc, char** argv) {
    return tools::run_in_team([&](tools::team_member& me) { return run(argc, argv, me); });
}
