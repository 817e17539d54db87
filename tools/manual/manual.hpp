#pragma once
/// \file
/// Manual pages, and completion for shells: made of what a command line says of itself.

#include "tools/manual/help_text.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// An option, and for which words ahead of the inputs it is.
struct offered_option {
    option_text text{};
    std::vector<std::string> names{};  ///< "-o", "--output", aliases left out
    std::vector<std::string> modes{};  ///< with their other names; none: for all
    bool repeatable = false;
    bool own = false;           ///< of a mode with a command line of its own
    bool without_mode = false;  ///< instead of a mode

    [[nodiscard]] bool takes_file() const { return text.value == "FILE"; }
    [[nodiscard]] bool takes_folder() const { return text.value == "DIR"; }
};

/// All options that are listed, those of modes with command lines of their own, too. One that
/// differs between them is there several times.
[[nodiscard]] std::vector<offered_option> options_of(const command_text& command);

/// Names of all modes.
[[nodiscard]] std::vector<std::string> mode_names(const command_text& command);

/// The words with `between` between them.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// A script for bash: to be sourced, or put into share/bash-completion/completions.
[[nodiscard]] std::string bash_completion(const command_text& command);
/// One for zsh: the file _NAME of a folder in its fpath.
[[nodiscard]] std::string zsh_completion(const command_text& command);
[[nodiscard]] std::string fish_completion(const command_text& command);
/// A page for man, in section 1. `version` stands at its foot.
[[nodiscard]] std::string man_page(const command_text& command, const std::string& version);

/// That of them which `kind` names: man, bash, zsh or fish; none for other words.
[[nodiscard]] std::optional<std::string> manual_of(const command_text& command,
                                                   std::string_view kind,
                                                   const std::string& version);

}  // namespace tools
