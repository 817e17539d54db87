#include "tools/common/console.hpp"

#include "tools/common/exit_status.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
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
    put_line(stderr, line);
    if (log_) put_line(log_.get(), line);
}

void console::result(std::string_view text) {
    end_progress();
    if (most_ != level::error) put_line(result_stream_, text);
    if (log_) put_line(log_.get(), text);
}

void console::progress(std::string_view step, double share) {
    if (!progress_) return;
    const auto now = std::chrono::steady_clock::now();
    if (line_open_ && now - last_shown_ < std::chrono::milliseconds(100)) return;
    last_shown_ = now;
    line_open_ = true;
    std::fprintf(stderr, "\r\033[K%s: %.*s %3d %%", tool_.c_str(), static_cast<int>(step.size()),
                 step.data(), static_cast<int>(100.0 * share));
    std::fflush(stderr);
}

void console::end_progress() {
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

}  // namespace tools
