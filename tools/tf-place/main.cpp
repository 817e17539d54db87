/// \file
/// tf-place: finds where to put one mesh with respect to others.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-place/assembly/assembly.hpp"
#include "tools/tf-place/place.hpp"

#include <string>
#include <string_view>

int main(int argc, char** argv) {
    tools::assembly_command clash("clash");
    tools::assembly_command check("check");
    for (tools::assembly_command* one : {&clash, &check})
        if (argc > 1 && argv[1] == one->mode()) return one->run(argc, argv);
    tools::command_line line(
        "tf-place", "MODE [OPTIONS] MOVING...",
        "Place a mesh or a point cloud relative to others.\n"
        "The result never penetrates: it is checked in the precision that is written.");
    tools::place_settings s;
    tools::fixed_meshes fixed;
    tools::common_options options;
    options.suffix = "-place";
    options.table = {{"travel", "/travel", false},
                     {"distance", "/distance", false},
                     {"contacts", "/contact_count"}};
    line.word("MODE", [&](std::string_view text) {
        s.mode_text = text;
        options.joined = text == "pack";  // they go to one plate
    });
    line.inputs(options.inputs,
                "meshes: STL OBJ PLY OFF GLB/glTF 3MF; points: PLY\n"
                "PCD LAS LAZ XYZ PTS CSV; or folders of them; \"-\" =\n"
                "stdin. LAS and LAZ are read, but not written",
                "MOVING");
    options.takes_points = true;
    line.group("Modes");
    line.describe(tools::help_text);
    line.mode({.name = "clash", .text = "all pairs of parts of assemblies: see clash --help"},
              clash.line());
    line.mode({.name = "check", .text = "parts or a robot in many poses: see check --help"},
              check.line());
    tools::add_options(line, s, options);
    line.group("Common options");
    tools::add_common_options(
        line, options, {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf", "xyz"}});
    return tools::run(
        line, options, {"read", "prepare", "search", "round", "write"}, argc, argv,
        [&] { tools::check_settings(line, s, options); },
        [&](tools::job& work) {
            tools::enter_blank_report(work, s);
            tools::check_outputs(work, {s.matrix}, {s.deviation.distances});
            return options.joined ? tools::pack_all(work, s) : tools::place_one(work, s, fixed);
        });
}
