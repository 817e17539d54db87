#include "tools/shell/change_limits.hpp"

#include "tools/shell/console.hpp"
#include <treeform/mesh/certificate.hpp>
#include <treeform/tf.hpp>

namespace tools {

void add_max_move(command_line& line, change_limits& target) {
    line.option(target.max_move,
                {"--max-move", "DIST", "fail (exit 1) if rounding moves a point further", "0.1%"});
}

void add_max_loss(command_line& line, change_limits& target) {
    line.option({"--max-loss", "SHARE", "fail (exit 1) if more of the solid is lost", "5%"},
                [&t = target.max_loss](std::string_view v) { t = parse_share("--max-loss", v); });
    line.flag(target.accept_loss, {"--accept-loss", "", "write the result even if more is lost"});
}

std::string move_objection(json& entry, const change_limits& limits, double diagonal,
                           const tf::certificate& known, tf::points_view points) {
    const double allowed = limits.max_move.used(diagonal), moved = known.max_displacement;
    entry["max_move"] = {{"given", limits.max_move.given},
                         {"used", allowed},
                         {"largest", moved},
                         {"step", tf::coordinate_step(points, known.precision)}};
    if (moved <= allowed) return {};
    // Six digits round by at most 5e-6 of the number: the limit that is shown is large enough.
    return "a point would move by " + brief(moved * (1.0 + 5e-6)) + ", more than " +
           brief(allowed) + " (--max-move)" +
           (known.precision == tf::precision::float32
                ? "; to reduce rounding, write PLY, OBJ or OFF with --precision double, or first "
                  "move the inputs near the origin"
                : "");
}

}  // namespace tools
