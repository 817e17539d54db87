/// \file
/// tf-place: finds where to put one mesh with respect to others.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-place/assembly/assembly.hpp"
#include "tools/tf-place/place.hpp"
#include "tools/tf-place/placing/modes.hpp"

#include <string>
#include <string_view>

namespace {

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
    "  tf-place lay part.stl --stable -o stands.stl\n"
    "  tf-place turn door.stl --fixed wall.stl --origin 4,0,0 -o open.stl\n"
    "  tf-place mate bolt.stl --fixed plate.stl --feature axis -o in_hole.stl\n"
    "  tf-place pack a.stl b.stl --count b.stl:20 --size 250,210 --plates 3 -o p.3mf\n"
    "  tf-place fit scan.ply --fixed part.stl --trim 0.2 --starts 50 -o fitted.ply\n"
    "\n"
    "Exit status: 0 placed, or measured; 1 no such place, or in doubt: as MODE --help\n"
    "  says; 2 usage; 3 input; 4 output; 5 stopped (memory, timeout, signal); 70 bug.\n"
    "  Of several inputs, the highest.\n";

}  // namespace

int main(int argc, char** argv) {
    tools::assembly_command clash("clash");
    tools::assembly_command check("check");
    for (tools::assembly_command* one : {&clash, &check})
        if (argc > 1 && argv[1] == one->mode()) return one->run(argc, argv);
    tools::command_line line(
        "tf-place", "MODE [OPTIONS] MOVING...",
        "Find where to put one mesh (or point set) with respect to others.\n"
        "The result never penetrates: it is checked again in the precision written.");
    tools::place_settings s;
    tools::fixed_meshes fixed;
    tools::common_options options;
    options.suffix = "-place";
    options.table = {{"travel", "/travel", false},
                     {"distance", "/distance", false},
                     {"contacts", "/contact_count"}};
    line.word("MODE", [&](std::string_view text) {
        s.mode_text = text;
        options.joined = text == "arrange" || text == "pack";  // they go to one plate
    });
    line.inputs(options.inputs,
                "meshes: STL OBJ PLY OFF GLB/glTF 3MF; points: PLY\n"
                "PCD XYZ CSV; or folders of them; \"-\" = stdin",
                "MOVING");
    options.content = tf::file_content::meshes_and_points;
    tools::add_place_modes(line, clash.line(), check.line());
    tools::add_options(line, s, options);
    line.group("Common options");
    tools::add_common_options(
        line, options, {.output_formats = {"ply", "obj", "stl", "off", "glb", "3mf", "xyz"}});
    line.epilogue(epilogue);
    return tools::run(
        line, options, {"read", "prepare", "search", "settle", "write"}, argc, argv,
        [&] { tools::check_settings(line, s, options); },
        [&](tools::job& work) {
            tools::enter_blank_report(work, s);
            tools::check_outputs(work, {s.matrix}, {s.deviation.distances});
            return options.joined ? tools::arrange_all(work, s) : tools::place_one(work, s, fixed);
        });
}
