#pragma once
/// \file
/// The page that --help prints, in columns.

#include <string>
#include <vector>

namespace tools {

/// One option. `names` as typed by the user, "-t, --tolerance"; `text` may have several lines, and
/// an option without one is accepted but not listed.
struct option_text {
    std::string names{};
    std::string value{};  ///< what follows the name: "DIST"; empty for a flag
    std::string text{};
    std::string fallback{};  ///< what holds without the option; shown in brackets at the right
    std::string label{};     ///< shown in place of `names`, where not empty
    std::string aliases{};   ///< further names, not shown: "--eps,--threshold"
};

struct option_group {
    std::string title{};
    std::vector<option_text> options{};
};

/// The group's title and options, at most 80 columns wide where the texts are.
[[nodiscard]] std::string lay_out(const option_group& group);

}  // namespace tools
