#pragma once
/// \file
/// Standard input, where it is read more than once.

#include "tools/shell/abrupt_exit.hpp"
#include "tools/shell/run.hpp"

#include <filesystem>

namespace tools {

/// Standard input as a file for as long as this lives; what is read from standard input then comes
/// from there, too. What processes that were killed have left of theirs is removed.
class spooled_input {
  public:
    /// The file's name begins with `beside`. \throws failure
    spooled_input(job& work, const std::filesystem::path& beside);
    spooled_input(const spooled_input&) = delete;
    spooled_input& operator=(const spooled_input&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return path_.path(); }

  private:
    guard& keeper_;
    unfinished_path path_;
};

}  // namespace tools
