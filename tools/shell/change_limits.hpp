#pragma once
/// \file
/// Limits within which a mesh may be changed, and the options that set them.

#include "tools/shell/command_line.hpp"
#include "tools/shell/entries.hpp"
#include <treeform/tf.hpp>

#include <array>
#include <string>

namespace tools {

struct change_limits {
    distance max_move{.given = "0.1%", .value = 1e-3, .relative = true};  ///< of any point
    double max_loss = 0.05;
    bool accept_loss = false;

    [[nodiscard]] double loss() const { return accept_loss ? 1.0 : max_loss; }
};

/// By `fill_rule`.
inline constexpr std::array<const char*, 3> fill_rules{"nonzero", "even-odd", "positive"};

void add_max_move(command_line& line, change_limits& target);
void add_max_loss(command_line& line, change_limits& target);

/// Enters given, used and largest move as "max_move"; why that is too far, or nothing where it is
/// not. `diagonal` is that of the input's box.
[[nodiscard]] std::string move_objection(json& entry, const change_limits& limits, double diagonal,
                                         const tf::certificate& known, tf::points_view points);

}  // namespace tools
