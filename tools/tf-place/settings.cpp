#include "tools/shell/align_options.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/tf-place/place.hpp"
#include "tools/tf-place/placing/pack_options.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

namespace tools {
namespace {

constexpr std::array<const char*, 9> modes{"drop",    "lay",  "slide", "mate", "separate",
                                           "measure", "pack", "align", "turn"};
place_mode parse_mode(std::string_view text) {
    const auto at = std::find(modes.begin(), modes.end(), text);
    if (at == modes.end())
        refuse(std::string(text) + ": not a mode; expected one of " + listed(modes));
    return static_cast<place_mode>(at - modes.begin());
}

void add_options_of_modes(command_line& line, place_settings& s) {
    add_feature_options(line, s.feature);
    add_turn_options(line, s.turn);
    add_lay_options(line, s.lay);
    add_pack_options(line, s.pack);
    line.option(s.max_distance, {"--max-distance", "DIST", "align: ignore pairs further apart"});
    add_align_options(line, s.align);
    add_deviation_options(line, s.deviation);
}

}  // namespace

const char* name_of(place_mode mode) { return modes[static_cast<std::size_t>(mode)]; }

void add_options(command_line& line, place_settings& s, common_options& options) {
    line.group("Options");
    line.repeatable_option(options.also_read,
                           {"--fixed", "FILE",
                            "mesh or cloud that does not move (repeatable); its\n"
                            "objects, groups or nodes are separate bodies, unless\n"
                            "they have points in common"});
    line.option({"--bed", "Z",
                 "drop, lay, pack: height of the bed; drop with\n"
                 "--fixed has a bed only if this is given",
                 "0"},
                [&s](std::string_view text) { s.bed = parse_number("--bed", text); });
    line.option(
        {"-d, --direction", "X,Y,Z", "slide, drop: direction of travel", "0,0,-1"},
        [&s](std::string_view text) { s.direction = parse_direction("--direction", text); });
    line.option(s.clearance, {"--clearance", "DIST", "least distance from --fixed", "0"});
    line.option(s.max_travel,
                {"--max-travel", "DIST", "largest travel (exit 1 if it is not enough)"});
    add_options_of_modes(line, s);
    line.option(s.start, {"--start", "FILE",
                          "matrix applied to MOVING first: 4x4 numbers, or the\n"
                          "matrix in a report of tf-place"});
    line.group("Output");
    line.output(options.output, {"-o, --output", "FILE",
                                 "MOVING at its new place; of measure, MOVING unchanged;\n"
                                 "in PLY and GLB, faces that penetrate --fixed are red,\n"
                                 "touching ones yellow, those within --clearance cyan,\n"
                                 "unless MOVING has colors"});
    line.flag(s.scene, {"--scene", "",
                        "write the fixed meshes to -o or --output-dir, too,\n"
                        "with the names of their parts"});
    line.output(s.matrix, {"--matrix", "FILE",
                           "4x4 matrix, 4 lines, row-major, column vectors:\n"
                           "new = M * old, in file coordinates; \"-\" = stdout"});
}

void check_settings(const command_line& line, place_settings& s, common_options& o) {
    using enum place_mode;
    s.mode = parse_mode(s.mode_text);
    s.fixed = o.also_read;
    if (!s.start.empty()) o.also_read.push_back(s.start);
    const std::string& mode = s.mode_text;
    const auto is = [&](auto... any) { return ((s.mode == any) || ...); };
    const auto given = [&](const auto& names) {
        return std::count_if(names.begin(), names.end(),
                             [&](const char* name) { return line.given(name); });
    };
    const auto sides_chosen = given(side_option_names());
    const bool clearance = s.clearance.value > 0.0, mesh = wants_mesh(o);
    const bool form = o.ascii || o.binary || o.precision != "keep" || !o.output_format.empty();
    const std::initializer_list<std::pair<bool, std::string>> refused{
        {!is(lay) && given(lay_option_names()) > 0, listed(lay_option_names()) + " are for lay"},
        {is(lay) && sides_chosen > 1, listed(side_option_names()) + " exclude each other"},
        {!is(turn) && given(turn_option_names()) > 0,
         listed(turn_option_names()) + " are for turn"},
        {!is(place_mode::mate) && given(feature_option_names()) > 0,
         listed(feature_option_names()) + " are for mate"},
        {!s.feature.kind && given(feature_option_names()) > 0,
         "--pick, --pick-fixed and --flip need --feature"},
        {(is(turn) || s.feature.kind) && s.max_travel,
         "--max-travel is not for turn or mate --feature"},
        {is(lay) && !s.fixed.empty(), "--fixed: lay puts MOVING on an empty bed"},
        {is(lay) && clearance, "--clearance: lay puts MOVING onto the bed"},
        {is(lay) && s.max_travel, "--max-travel: lay puts MOVING onto the bed"},
        {!is(pack) && given(pack_option_names()) > 0,
         listed(pack_option_names()) + " are for pack"},
        {!is(align) && (line.given("--max-distance") || given(align_option_names()) > 0),
         "--max-distance, " + listed(align_option_names()) + " are for align"},
        {given(std::array{"--overlap", "--trim"}) > 1, "--overlap and --trim exclude each other"},
        {is(pack) && !line.given("--size"), "pack needs --size"},
        {is(pack) && !s.fixed.empty(), "--fixed: pack puts MOVING on an empty plate"},
        {is(align) && s.fixed.size() > 1, "align takes one --fixed"},
        {is(pack, align) && (clearance || s.max_travel),
         "--clearance and --max-travel are not for " + mode},
        {!is(drop, lay, pack) && s.fixed.empty(), mode + " needs --fixed"},
        {!is(drop, lay, pack) && s.bed, "--bed is for drop, lay and pack"},
        {!is(drop, slide) && s.direction, "--direction is for slide and drop"},
        {s.has_bed() && s.direction && !(s.direction->z < 0.0),
         "--direction: expected a direction down to the bed, Z below 0"},
        {!is(measure) && s.deviation.wanted(), "--distances and --tolerance-band are for measure"},
        {!is(measure) && s.deviation.no_depth, "--no-depth is for measure"},
        {is(measure) && s.max_travel, "--max-travel: measure moves nothing"},
        {is(measure) && !s.matrix.empty(), "--matrix: measure moves nothing"},
        {is(measure) && o.in_place, "--in-place: measure moves nothing"},
        {is(lay) && s.scene, "--scene: lay has no fixed meshes"},
        {is(pack) && s.scene, "--scene: pack always writes all parts"},
        {s.scene && (!mesh || o.in_place), "--scene needs -o or --output-dir"},
        {!mesh && form,
         "--output-format, --ascii, --binary and --precision need -o, --output-dir or --in-place"}};
    for (const auto& [broken, text] : refused)
        if (broken) refuse(text);
    if (!is(measure)) require_output(line, o);
}

}  // namespace tools
