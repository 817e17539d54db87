#include "tools/tf-place/placing/lay_options.hpp"

#include "tools/shell/exit_status.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace tools {
namespace {

constexpr std::array<const char*, 7> names{"--largest-face",  "--stable",    "--face-normal",
                                           "--face-point",    "--tolerance", "--keep-spin",
                                           "--overhang-angle"};

}  // namespace

void add_lay_options(command_line& line, lay_settings& s) {
    line.flag(s.largest_side,
              {"--largest-face", "", "lay: on the largest side of the convex hull", "this"});
    line.option(
        {"--face-normal", "X,Y,Z", "lay: on the side whose normal is nearest to this"},
        [&s](std::string_view text) { s.options.normal = parse_direction("--face-normal", text); });
    line.option(
        {"--face-point", "X,Y,Z", "lay: on the side that contains this point"},
        [&s](std::string_view text) { s.options.point = parse_point("--face-point", text); });
    line.flag(s.options.most_stable, {"--stable", "",
                                      "lay: on the side with the largest tip angle; the mass\n"
                                      "of an open mesh is in its surface"});
    line.option(s.flatness, {"-t, --tolerance", "DIST",
                             "lay: points within DIST of the plane of a side belong\n"
                             "to the side and are moved onto it; 0: exactly coplanar\n"
                             "ones only",
                             "0.0001%"});
    line.flag(s.options.keep_spin, {"--keep-spin", "", "lay: do not rotate about the vertical"});
    line.option({"--overhang-angle", "DEG",
                 "lay: faces that face down and lean from the vertical\n"
                 "by more than this count as overhang in the report",
                 "45"},
                [&s](std::string_view text) {
                    const double angle = parse_number("--overhang-angle", text);
                    if (!(angle >= 0.0 && angle <= 90.0))
                        refuse("--overhang-angle " + std::string(text) + ": expected 0 to 90");
                    s.options.overhang_angle = angle;
                });
}

std::span<const char* const> lay_option_names() { return names; }
std::span<const char* const> side_option_names() { return std::span(names).first(4); }

json lay_entry(const tf::laid_flat& laid) {
    constexpr std::array<const char*, 4> masses{"points", "", "surface", "solid"};
    json sides = json::array();
    for (std::size_t i = 0; i < laid.sides.size(); ++i) {
        const tf::hull_side& side = laid.sides[i];
        sides.push_back({{"normal", side.normal},
                         {"area", side.area},
                         {"center", side.center},
                         {"tip_angle", laid.tip_angles[i]},
                         {"height", laid.center_heights[i]},
                         {"overhang", or_null(!std::isnan(laid.overhangs[i]), laid.overhangs[i])}});
    }
    return {{"sides", sides},
            {"chosen", laid.chosen},
            {"corrected", laid.corrected},
            {"center_of_mass",
             {{"point", laid.center_of_mass},
              {"of", masses[static_cast<std::size_t>(laid.mass_dimension)]}}}};
}

}  // namespace tools
