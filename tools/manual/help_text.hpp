#pragma once
/// \file
/// What a command line accepts, in words; and the page that --help prints, in columns.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tools {

/// One option. `names` as typed by the user, "-t, --tolerance"; `text` may have several lines, and
/// an option without one is accepted but not listed. A text that begins with names of modes, as in
/// "slide, drop: direction of travel", is of an option for these alone.
struct option_text {
    std::string names{};
    std::string value{};  ///< what follows the name: "DIST"; empty for a flag
    std::string text{};
    std::string fallback{};  ///< what holds without the option; shown in brackets at the right
    std::string label{};     ///< shown in place of `names`, where not empty
    std::string aliases{};   ///< further names, not shown: "--eps,--threshold"
    /// For completion: the words that the value may be, or the extensions that a FILE may have.
    std::vector<std::string> offered{};
};

struct option_group {
    std::string title{};
    std::vector<option_text> options{};
};

/// A word ahead of the inputs that says what to do.
struct mode_text {
    std::string name{};
    std::string text{};                  ///< in the list of modes; may have several lines
    std::string usage{};                 ///< "slide --fixed FILE [OPTIONS] MOVING..."
    std::string more{};                  ///< of its help alone: what it prints, an example
    std::vector<std::string> without{};  ///< "--matrix": options that are not for it either
};

/// All that a command line says of itself.
struct command_text {
    std::string name{};     ///< "tf-place"
    std::string usage{};    ///< what follows the name
    std::string purpose{};  ///< one or two lines
    std::string inputs_name = "INPUT";
    std::string inputs_text{};
    std::vector<std::string> input_extensions{};  ///< for completion
    bool needs_mode = false;                      ///< ahead of the inputs
    std::vector<option_group> groups{};
    std::vector<mode_text> modes{};
    std::string epilogue{};  ///< "Examples:" and "Exit status:" begin paragraphs of it
    /// Of modes that are command lines of their own.
    std::vector<std::pair<std::string, const command_text*>> own{};
};

/// A tool's help.txt, which the build puts into it. Sections begin with their name in brackets;
/// that of a mode has its text, its usage, options that are not for it, and what its help says.
extern const std::string_view help_text;

/// Names and texts of all sections.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> sections_of(std::string_view help);

/// The mode of a section.
[[nodiscard]] mode_text mode_of(std::string name, std::string_view section);

/// "drop", "lay" of "drop, lay".
[[nodiscard]] std::vector<std::string> words_of(std::string_view list);

/// The modes that the option's text begins with, "slide, drop"; empty where it is for all.
[[nodiscard]] std::string_view modes_of(const option_text& option,
                                        const std::vector<mode_text>& modes);

/// The groups without what is not for `mode`, nor with the modes ahead of texts.
[[nodiscard]] std::vector<option_group> groups_for(const mode_text& mode,
                                                   const std::vector<option_group>& groups,
                                                   const std::vector<mode_text>& modes);

/// What --help prints; for `word`, if it is one of the modes.
[[nodiscard]] std::string help_of(const command_text& command, std::string_view word = {});

/// The group's title and options, at most 80 columns wide where the texts are.
[[nodiscard]] std::string lay_out(const option_group& group);

}  // namespace tools
