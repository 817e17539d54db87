#include "tools/shell/console.hpp"

#include "tools/shell/exit_status.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace tools {
namespace {

std::string_view prefix(level l) {
    switch (l) {
        case level::error:
            return "error: ";
        case level::warning:
            return "warning: ";
        case level::info:
            return "";
        case level::debug:
            return "debug: ";
    }
    return "";
}

constexpr const char* bold = "\033[1m";
constexpr const char* red = "\033[1;31m";
constexpr const char* yellow = "\033[1;33m";
constexpr const char* plain = "\033[0m";

bool takes_colors(std::FILE* stream) {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    // What mpirun gives its processes looks like a terminal, wherever its own output goes.
    const bool under_mpirun = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
    return isatty(fileno(stream)) == 1 && !under_mpirun &&
           (no_color == nullptr || *no_color == '\0') &&
           (terminal == nullptr || std::string_view(terminal) != "dumb");
}

/// What is ahead of the first ": ", the name, stands out.
std::string with_bold_name(std::string_view text) {
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) return std::string(text);
    return std::string(bold) + std::string(text.substr(0, colon)) + plain +
           std::string(text.substr(colon));
}

/// "12 s", "3 min 5 s", "2 h 10 min"
std::string in_time(double seconds) {
    const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600)
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

void put_line(std::FILE* stream, std::string_view text) {
    std::string line(text);
    line += '\n';
    std::fwrite(line.data(), 1, line.size(), stream);
    std::fflush(stream);
}

}  // namespace

void console::configure(level most, bool progress) {
    most_ = most;
    progress_ = progress;
}

void console::color(std::string_view when) {
    color_out_ = when == "always" || (when == "auto" && takes_colors(stdout));
    color_err_ = when == "always" || (when == "auto" && takes_colors(stderr));
}

void console::log_to(const std::filesystem::path& path) {
    log_.reset(std::fopen(path.c_str(), "a"));
    if (!log_)
        throw failure(bad_output, "log",
                      path.string() +
                          ": cannot append to the log: " + std::generic_category().message(errno));
}

void console::say(level l, std::string_view text) {
    if (!shows(l)) return;
    end_progress();
    std::string line = tool_ + ": ";
    line += prefix(l);
    line += text;
    const bool grave = l == level::error || l == level::warning;
    if (color_err_ && grave)
        put_line(stderr, std::string(bold) + tool_ + ":" + plain + " " +
                             (l == level::error ? red : yellow) + std::string(prefix(l)) + plain +
                             std::string(text));
    else
        put_line(stderr, line);
    if (log_) put_line(log_.get(), line);
}

void console::result(std::string_view text) {
    end_progress();
    if (most_ != level::error)
        put_line(result_stream_, colors_of_results() ? with_bold_name(text) : std::string(text));
    if (log_) put_line(log_.get(), text);
}

void console::table(std::string_view text) {
    if (most_ == level::error || isatty(fileno(result_stream_)) != 1) return;
    const std::size_t heading = text.find('\n');
    put_line(result_stream_, "");
    put_line(result_stream_, colors_of_results() ? bold + std::string(text.substr(0, heading)) +
                                                       plain + std::string(text.substr(heading))
                                                 : std::string(text));
}

void console::progress(std::string_view step, double share, std::uint64_t count,
                       std::string_view things) {
    if (!progress_) return;
    const auto now = std::chrono::steady_clock::now();
    if (step != step_) {
        step_ = step;
        step_began_ = now;
    }
    if (line_open_ && now - last_shown_ < std::chrono::milliseconds(100)) return;
    last_shown_ = now;
    line_open_ = true;
    std::string line = "\r\033[K" + tool_ + ": " + step_ + " " +
                       std::to_string(static_cast<int>(100.0 * share)) + " %";
    const std::chrono::duration<double> spent = now - step_began_;
    if (spent.count() > 0.5 && share > 0.0 && share < 1.0) {  // too early, it would be a guess
        if (count > 0)
            line += ", " + brief(std::round(static_cast<double>(count) * share / spent.count())) +
                    " " + std::string(things) + "/s";
        line += ", " + in_time(spent.count() * (1.0 - share) / share) + " left";
    }
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
}

void console::end_progress() {
    step_.clear();
    if (!line_open_) return;
    line_open_ = false;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
}

std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3;) {
        i -= 3;
        text.insert(i, 1, ',');
    }
    return text;
}

std::string brief(double value) {
    char text[32];
    const bool large = std::abs(value) >= 1e6 && std::abs(value) < 1e15;
    const auto form = large ? std::chars_format::fixed : std::chars_format::general;
    return {text, std::to_chars(text, text + sizeof text, value, form, large ? 0 : 6).ptr};
}

std::string in_bytes(std::uint64_t bytes) {
    const bool large = bytes >= 1'000'000'000;
    char text[32];
    const auto end =
        std::to_chars(text, text + sizeof text, static_cast<double>(bytes) / (large ? 1e9 : 1e6),
                      std::chars_format::fixed, large ? 1 : 0)
            .ptr;
    return std::string(text, end) + (large ? " GB" : " MB");
}

std::string shortest(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

std::string counted(std::uint64_t number, std::string_view one, std::string_view many) {
    return grouped(number) + " " + std::string(number == 1 ? one : many);
}

failure no_triangles(const std::string& name, std::uint64_t triangles, std::uint64_t points) {
    return {bad_input, "no-triangles",
            name + (triangles > 0 ? ": no triangle with finite coordinates"
                                  : ": no triangles (" + counted(points, "point", "points") + ")")};
}

}  // namespace tools
