#pragma once
/// \file
/// What a tool tells the shell, and the exception that carries it.

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace tools {

/// In rising order of gravity: of several inputs the gravest outcome is the tool's.
enum exit_status : int {
    done = 0,        ///< nothing found, or all done
    found = 1,       ///< found, or not fully done
    bad_usage = 2,   ///< the command line makes no sense
    bad_input = 3,   ///< a file cannot be read, or holds nothing to work on
    bad_output = 4,  ///< a file cannot be written
    stopped = 5,     ///< by memory, time or a signal
    bug = 70         ///< must not happen
};

[[nodiscard]] constexpr exit_status worse(exit_status a, exit_status b) { return std::max(a, b); }

/// The end of the work on one input, or of the run. `code()` is for scripts and goes to the report;
/// `what()` is a sentence for people.
class failure : public std::runtime_error {
  public:
    failure(exit_status status, std::string code, const std::string& text)
        : std::runtime_error(text), status_(status), code_(std::move(code)) {}
    [[nodiscard]] exit_status status() const { return status_; }
    [[nodiscard]] const std::string& code() const { return code_; }

  private:
    exit_status status_;
    std::string code_;
};

/// The failure of a file without a usable triangle: it has none, or none of them is finite.
[[nodiscard]] failure no_triangles(const std::string& name, std::uint64_t triangles,
                                   std::uint64_t points);

/// Says that the command line makes no sense.
[[noreturn]] inline void refuse(const std::string& text) {
    throw failure(bad_usage, "usage", text);
}

}  // namespace tools
