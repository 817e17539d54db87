#pragma once
/// \file
/// What a tool says to the person at the terminal, all of it on standard error.

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tools {

enum class level { error, warning, info, debug };

class console {
  public:
    explicit console(std::string tool) : tool_(std::move(tool)) {}

    /// Messages up to `most` are shown; progress only where `progress` says so.
    void configure(level most, bool progress);
    /// Which of the streams gets colors. `when` is "always", "never" or "auto": a terminal does,
    /// unless the environment has NO_COLOR, or says that the terminal is dumb.
    void color(std::string_view when);
    /// Messages shown are also appended to the file at `path`. \throws failure (bad_output)
    void log_to(const std::filesystem::path& path);

    void error(std::string_view text) { say(level::error, text); }
    void warning(std::string_view text) { say(level::warning, text); }
    void info(std::string_view text) { say(level::info, text); }
    void debug(std::string_view text) { say(level::debug, text); }

    /// The result in words: on standard output, unless that carries data (`result_to_stderr`).
    void result(std::string_view text);
    void result_to_stderr() { result_stream_ = stderr; }
    /// The same for `text` of several lines, where somebody looks at a terminal.
    void table(std::string_view text);

    /// Shows how far `step` has come, a few times a second, how fast it is with `count` things, if
    /// that is not 0, and how long it may still take; call `end_progress` when it is over.
    void progress(std::string_view step, double share, std::uint64_t count = 0,
                  std::string_view things = {});
    void end_progress();

    [[nodiscard]] bool shows(level l) const { return l <= most_; }

  private:
    struct close_file {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void say(level l, std::string_view text);
    [[nodiscard]] bool colors_of_results() const {
        return result_stream_ == stdout ? color_out_ : color_err_;
    }

    std::string tool_;
    level most_ = level::warning;
    bool progress_ = false;
    bool line_open_ = false;
    bool color_out_ = false;
    bool color_err_ = false;
    std::string step_;  ///< that is shown
    std::chrono::steady_clock::time_point step_began_{};
    std::FILE* result_stream_ = stdout;
    std::chrono::steady_clock::time_point last_shown_{};
    std::unique_ptr<std::FILE, close_file> log_;
};

/// 26306 as "26,306".
[[nodiscard]] std::string grouped(std::uint64_t number);
/// Six digits, and no fewer than stand ahead of the point: for sentences. The report has all.
[[nodiscard]] std::string brief(double value);
/// The shortest decimal text that reads back as `value`: for files, and for numbers that people
/// type back as a limit, which a rounded one would not meet.
[[nodiscard]] std::string shortest(double value);
/// "512 MB", "22.4 GB".
[[nodiscard]] std::string in_bytes(std::uint64_t bytes);
/// "1 pair", "2 pairs".
[[nodiscard]] std::string counted(std::uint64_t number, std::string_view one,
                                  std::string_view many);

}  // namespace tools
