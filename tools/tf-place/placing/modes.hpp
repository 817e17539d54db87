#pragma once
/// \file
/// The modes of tf-place, in words: what each does, prints, and an example.

#include "tools/shell/command_line.hpp"

namespace tools {

/// As a group of their own. `clash` and `check` are command lines of their own.
void add_place_modes(command_line& line, const command_line& clash, const command_line& check);

}  // namespace tools
