/// \file
/// tf-selfintersect: finds the self-intersections of triangle meshes, and resolves them.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/shell/tile_options.hpp"
#include "tools/tf-selfintersect/in_tiles.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/tf.hpp>

#include <array>

namespace {

using tools::command_line;
using tools::common_options;
using tools::exit_status;

struct request {
    tools::search_settings search;
    std::uint64_t limit = 10000;
    std::filesystem::path pairs;
    std::filesystem::path curves;
    bool repairs = false;
    tools::repair_settings repair;
    tools::tile_options tiles;
};

tf::box3 parse_box(std::string_view text) {
    const auto v = tools::parse_numbers("--box", text, 6);
    const tf::box3 box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    if (v[0] > v[3] || v[1] > v[4] || v[2] > v[5])
        tools::refuse("--box " + std::string(text) + ": expected X0,Y0,Z0 not above X1,Y1,Z1");
    return box;
}

void add_what_counts(command_line& line, tools::search_settings& s) {
    line.group("What is searched");
    line.flag(s.touching, {"--touching", "",
                           "also count faces that touch without crossing and are\n"
                           "not neighbors, and pairs with a degenerate face",
                           "off"});
    line.flag(s.no_coplanar, {"--no-coplanar", "", "do not count overlap, fold and duplicate"});
    line.flag(s.between, {"--between", "", "only pairs of different connected components"});
    line.flag(s.within, {"--within", "", "only pairs inside one connected component"});
    static constexpr std::array<const char*, 2> identities{"equal", "file"};
    line.option({"--vertices", "MODE",
                 "which corners are one vertex: file (indices as\n"
                 "stored) or equal (same coordinates)",
                 "equal for STL, else file"},
                [&s](std::string_view text) {
                    s.vertices = static_cast<tf::vertex_identity>(
                        tools::parse_choice("--vertices", text, identities));
                });
    line.offer("--vertices", {identities.begin(), identities.end()});
    line.option(s.tolerance, {.names = "-t, --tolerance",
                              .value = "DIST",
                              .text = "join corners within DIST before the search",
                              .fallback = "0",
                              .aliases = "--eps,--threshold"});
    line.option({"--box", "X0,Y0,Z0,X1,Y1,Z1", "only faces that meet this box"},
                [&s](std::string_view text) { s.box = parse_box(text); });
}

void add_outputs(command_line& line, request& r, common_options& options) {
    line.group("Output");
    line.flag(r.search.first, {"--first", "", "stop at the first pair found"});
    line.option(r.limit, {"--limit", "N",
                          "list at most N pairs in the report (counts, --pairs\n"
                          "and regions stay complete)",
                          "10000"});
    line.output(r.pairs, {"--pairs", "FILE", "all pairs as CSV: face,face,kind,region"});
    line.output(r.curves, {"--curves", "FILE", "intersection curves as OBJ or PLY lines"});
    line.output(options.output, {"-o, --output", "FILE",
                                 "the mesh with faces colored by kind, and properties\n"
                                 "tf_class and tf_region (PLY, GLB); with --repair the\n"
                                 "repaired mesh, and the input face of each face as\n"
                                 "property source_face (PLY)"});
}

void add_repair(command_line& line, request& r) {
    line.group("Repair");
    line.flag_with_value({.names = "--repair",
                          .text = "outer: cut faces that meet, keep the solid's boundary\n"
                                  "split: cut faces that meet, keep every piece\n"
                                  "remove: delete faces that meet, fill the holes",
                          .fallback = "outer",
                          .label = "--repair[=MODE]"},
                         tools::repair_modes, "outer", [&r](std::size_t mode) {
                             r.repairs = true;
                             r.repair.mode = static_cast<tf::resolve_mode>(mode);
                         });
    line.option(r.repair.fill_rule,
                {"--fill-rule", "RULE",
                 "for outer: which winding numbers are inside:\n"
                 "nonzero | even-odd | positive",
                 "nonzero"},
                tools::fill_rules);
    line.flag(r.repair.keep_cuts, {"--keep-cuts", "",
                                   "for outer: do not merge coplanar faces that were\n"
                                   "cut, or that overlap"});
    tools::add_max_move(line, r.repair.limits);
    tools::add_max_loss(line, r.repair.limits);
    line.flag(r.repair.keep_components,
              {"--keep-components", "", "fail (exit 1) if a component would disappear"});
}

void check_request(const command_line& line, request& r, common_options& options) {
    using tools::refuse;
    if (r.search.between && r.search.within) refuse("--between and --within exclude each other");
    tools::check_curve_path(r.curves);
    for (const char* name : {"--fill-rule", "--keep-cuts", "--max-move", "--max-loss",
                             "--accept-loss", "--keep-components"})
        if (!r.repairs && line.given(name)) refuse(std::string(name) + " needs --repair");
    if (line.given("--fill-rule") && r.repair.mode != tf::resolve_mode::outer)
        refuse("--fill-rule is for --repair=outer");
    if (r.repair.keep_cuts && r.repair.mode != tf::resolve_mode::outer)
        refuse("--keep-cuts is for --repair=outer");
    if (r.repairs && (r.search.first || r.search.between || r.search.within || r.search.box))
        refuse("--repair needs all pairs; it excludes --first, --between, --within and --box");
    if (options.in_place && !r.repairs)
        refuse("--in-place needs --repair; -o writes a copy with the faces colored");
    if (!r.repairs) options.mesh_formats = {"ply", "glb", "3mf"};  // that can hold marks
    if (!options.output.empty()) static_cast<void>(tools::mesh_format(options, options.output));
    if (!tools::wants_mesh(options)) {
        if (options.ascii || options.binary || !options.output_format.empty() ||
            (options.precision != "keep" && !r.repairs))
            refuse("--output-format, --ascii, --binary and --precision need -o or --output-dir");
        if (options.dry_run && !r.repairs) refuse("-n needs -o or --output-dir, or --repair");
    }
    if (r.repairs) tools::require_output(line, options);
    tools::check_tile_options(r.tiles, line, options);
    r.repair.touching = r.search.touching;
}

exit_status look_at(tools::job& work, const request& r) {
    const common_options& o = work.options;
    work.entry["tiles"] = nullptr;
    const bool leads = r.tiles.communicator.rank == 0;
    if (leads) tools::check_outputs(work, {r.pairs}, {r.curves});
    const auto output = tools::mesh_output(o, work.path);
    const bool keeps_mesh = r.repairs || (output && !o.dry_run);
    tf::mesh_file file;
    tools::findings result;
    if (tools::needs_tiles(work, r.search, r.tiles, keeps_mesh)) {
        if (r.tiles.is_part()) {
            tools::share_search(work, r.search, r.tiles);
            return tools::done;
        }
        const auto folder = r.tiles.folder_for(work, "tf-selfintersect",
                                               {r.pairs, r.curves, o.html, o.png, r.tiles.report});
        result = tools::work_in(work, folder, r.tiles, [&] {
            return tools::search_in_tiles(work, r.search, r.tiles, folder);
        });
    } else {
        file = work.read();
        result = tools::search(work, file, r.search, keeps_mesh);
    }

    if (!leads) return tools::done;
    work.out.result(work.name + ": " + tools::verdict(result, r.search));
    tools::say_details(work, result);
    tools::enter_report(work, result, r.search, r.limit);
    const bool found = !result.found.pairs.empty();
    if (found) tools::hint_at_near_points(work, result);
    {
        const auto timing = work.time("write");
        tools::write_pairs(work, r.pairs, result);
        tools::write_curves(work, r.curves, result);
        tools::write_page(work, result, r.search);
    }
    if (r.repairs)
        return tools::repair_and_write(work, file, result, r.repair, output) ? tools::done
                                                                             : tools::found;
    if (output && !o.dry_run) tools::write_marked(work, file, result, *output);
    return found ? tools::found : tools::done;
}

int run(int argc, char** argv, tools::team_member& me) {
    command_line line(
        "tf-selfintersect", "[OPTIONS] INPUT...",
        "Find self-intersections of triangle meshes and, with --repair, resolve them.\n"
        "Every verdict is exact on the coordinates as read.");
    request r;
    common_options options;
    r.tiles.communicator = me.communicator;
    options.in_team = true;
    options.failed = [&me](const std::string& text) { me.error = text; };
    options.suffix = "-selfintersect";
    options.table = {{"faces", "/faces"}, {"hit", "/faces_hit"}};
    for (const char* const kind :
         {"crossing", "pierce", "overlap", "fold", "duplicate", "touching", "degenerate"})
        options.table.push_back({kind, std::string("/pairs/") + kind});
    line.inputs(options.inputs, tools::mesh_inputs);
    add_what_counts(line, r.search);
    add_outputs(line, r, options);
    add_repair(line, r);
    tools::add_tile_options(
        line, r.tiles, "Files larger than --memory are searched in tiles on the disk (STL, PLY)",
        "--tile-faces");
    tools::add_sharing_options(line, r.tiles);
    line.group("Common options");
    tools::add_common_options(line, options,
                              {.output_formats = {"ply", "glb", "3mf", "obj", "stl", "off"}});
    line.describe(tools::help_text);
    return tools::run(
        line, options, {"read", "prepare", "tree", "pairs", "regions", "repair", "write"}, argc,
        argv,
        [&] {
            tools::leave_reports_to_first(r.tiles, options);
            check_request(line, r, options);
        },
        [&](tools::job& work) { return look_at(work, r); });
}

}  // namespace

int main(int argc, char** argv) {
    return tools::run_in_team([&](tools::team_member& me) { return run(argc, argv, me); });
}
