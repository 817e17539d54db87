#pragma once
/// \file
/// The options of laying flat, and what a report says of it.

#include "tools/shell/command_line.hpp"
#include "tools/shell/entries.hpp"
#include "tools/shell/parse_value.hpp"
#include <treeform/mesh/pack.hpp>
#include <treeform/tf.hpp>

#include <span>

namespace tools {

struct lay_settings {
    tf::lay_flat_options options{};  ///< which side, and the spin
    bool largest_side = false;
    /// Flat faces that were turned and rounded, to float32 mostly, are one side of the hull again.
    distance flatness{.given = "0.0001%", .value = 1e-6, .relative = true};
};

void add_lay_options(command_line& line, lay_settings& settings);
/// Their names: of all, and of those that choose a side.
[[nodiscard]] std::span<const char* const> lay_option_names();
[[nodiscard]] std::span<const char* const> side_option_names();

/// What there was to choose from.
[[nodiscard]] json lay_entry(const tf::laid_flat& laid);

}  // namespace tools
