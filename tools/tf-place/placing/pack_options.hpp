#pragma once
/// \file
/// The options of an arrangement on plates, and what a report says of one.

#include "tools/shell/command_line.hpp"
#include "tools/shell/entries.hpp"
#include <treeform/mesh/pack.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tools {

struct pack_settings {
    tf::pack_options pack{};
    std::vector<std::string> counts{};  ///< "FILE:N", as typed
    bool flat = false;                  ///< a height is a limit, and nothing more
};

/// All that only an arrangement has.
void add_pack_options(command_line& line, pack_settings& settings);
/// Their names.
[[nodiscard]] std::span<const char* const> pack_option_names();

/// How many of each input there are to be. \throws failure (bad_usage) for a count of no input
[[nodiscard]] std::vector<std::uint64_t> counts_of(const pack_settings& settings,
                                                   std::span<const std::string> inputs);

/// The options as the library takes them. With several plates, these are beside each other along
/// x, a fifth of their length apart.
[[nodiscard]] tf::pack_options pack_options_of(const pack_settings& settings);

/// What the entry of a report says of all parts together.
[[nodiscard]] json packing_entry(const tf::packing& found);

}  // namespace tools
