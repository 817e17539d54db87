#include "tools/tf-place/placing/modes.hpp"

namespace tools {
namespace {

/// Those that only go up or down, or along a line.
void add_ways(command_line& line) {
    line.mode({.names = "drop",
               .text = "translate down until MOVING rests on the bed or on\n--fixed; from below "
                       "the bed, up to it, if there is no\n--fixed",
               .usage = "drop [--fixed FILE] [OPTIONS] MOVING...",
               .more =
                   "Prints how far MOVING went, and what it touches. Exit status 1 if it falls\n"
                   "past all of --fixed, or penetrates at the start.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place drop data/sphere.ply --bed 5 -o high.ply\n"
                   "  data/sphere.ply: lifted by 6; touching the bed\n"});
    line.mode({.names = "lay",
               .text = "turn a flat side down, on the bed",
               .usage = "lay [OPTIONS] MOVING...",
               .more =
                   "Prints which side of the convex hull is down, and its area. The report lists\n"
                   "all sides: area, tip angle, overhang.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place lay data/cube.stl -o flat.stl\n"
                   "  data/cube.stl: laid on side 0 of 6, of area 1; touching the bed\n",
               .without = {"--fixed", "--clearance", "--max-travel"}});
    line.mode({.names = "slide",
               .text = "translate along --direction until contact (less\n--clearance)",
               .usage = "slide --fixed FILE [OPTIONS] MOVING...",
               .more =
                   "Prints how far MOVING went, and what it touches or how far that is. Exit\n"
                   "status 1 if nothing is in the way, or MOVING penetrates at the start.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place drop -q data/sphere.ply --bed 5 -o high.ply\n"
                   "  $ tf-place slide high.ply --fixed data/cube.stl --clearance 0.03 -o s.ply\n"
                   "  high.ply: slid by 3.97; clear, 0.0300002 from data/cube.stl\n"});
}

void add_meetings(command_line& line) {
    line.mode({.names = "mate",
               .text = "bring the closest points of MOVING and --fixed\n"
                       "together; with --feature, planes or axes",
               .usage = "mate --fixed FILE [OPTIONS] MOVING...",
               .more =
                   "Prints how far MOVING went, and what touches. Exit status 1 if it penetrates\n"
                   "at the start, or has no such feature.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place drop -q data/sphere.ply --bed 5 -o high.ply\n"
                   "  $ tf-place mate high.ply --fixed data/cube.stl -o at.ply\n"
                   "  high.ply: moved by 4; touching data/cube.stl (30 pairs of faces, the first "
                   "538 and 2)\n"});
    line.mode(
        {.names = "turn",
         .text = "turn about --axis through --origin until contact",
         .usage = "turn --fixed FILE [OPTIONS] MOVING...",
         .more = "Prints the angle, and what is touched. Exit status 1 if nothing is in the way.\n"
                 "\n"
                 "Examples:\n"
                 "  tf-place turn door.stl --fixed wall.stl --origin 4,0,0 -o open.stl\n",
         .without = {"--max-travel"}});
    line.mode(
        {.names = "clear, separate",
         .text = "out of --fixed, or away from it to --clearance: a\n"
                 "short translation, the shortest of many tried",
         .usage = "clear --fixed FILE [OPTIONS] MOVING...",
         .more = "Prints how far MOVING went, and how far it is from --fixed.\n"
                 "\n"
                 "Examples:\n"
                 "  $ tf-place clear data/sphere.ply --fixed data/cube.stl --clearance 1 -o a.ply\n"
                 "  data/sphere.ply: moved by 1.99575; clear, 1 from data/cube.stl\n"});
}

void add_others(command_line& line) {
    line.mode({.names = "arrange, pack",
               .text = "put all MOVING on plates, or in a box, without overlap",
               .usage = "arrange --size X,Y[,Z] [OPTIONS] MOVING...",
               .more =
                   "Prints how many parts have a place, and names those that have none: then the\n"
                   "exit status is 1. -o is the plate, or all plates side by side.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place pack data/cube.stl --count data/cube.stl:9 --size 20,20 -o p.stl\n"
                   "  data/cube.stl: 9 of 9 parts placed\n",
               .without = {"--fixed", "--clearance", "--max-travel", "--in-place", "--output-dir",
                           "--suffix"}});
    line.mode(
        {.names = "fit, align",
         .text = "align by ICP from the present position",
         .usage = "fit --fixed FILE [OPTIONS] MOVING...",
         .more = "Prints the number of steps, and the root mean square of the distances before\n"
                 "and after. Exit status 1 if it has not converged, or is in doubt.\n"
                 "\n"
                 "Examples:\n"
                 "  tf-place fit scan.ply --fixed part.stl -o aligned.ply\n"
                 "  tf-place fit scan.ply --fixed part.stl --trim 0.2 --starts 50 -o fitted.ply\n",
         .without = {"--clearance", "--max-travel"}});
    line.mode({.names = "measure",
               .text = "move nothing; report distance, contact,\npenetration, deviation",
               .usage = "measure --fixed FILE [OPTIONS] MOVING...",
               .more =
                   "Prints whether MOVING and --fixed are separate, touch or penetrate, and how\n"
                   "far or deep; for a cloud, how many points are inside. All of it is in the\n"
                   "report.\n"
                   "\n"
                   "Examples:\n"
                   "  $ tf-place drop -q data/sphere.ply --bed 5 -o high.ply\n"
                   "  $ tf-place measure high.ply --fixed data/cube.stl\n"
                   "  high.ply: separate, 4 from data/cube.stl\n",
               .without = {"--max-travel", "--matrix", "--in-place"}});
}

}  // namespace

void add_place_modes(command_line& line, const command_line& clash, const command_line& check) {
    line.group("Modes");
    add_ways(line);
    add_meetings(line);
    add_others(line);
    line.mode({.names = "clash", .text = "all pairs of parts of assemblies: see clash --help"},
              clash);
    line.mode({.names = "check", .text = "parts or a robot in many poses: see check --help"},
              check);
}

}  // namespace tools
