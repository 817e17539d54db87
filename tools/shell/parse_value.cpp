#include "tools/shell/parse_value.hpp"

#include "tools/shell/exit_status.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace tools {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view wanted) {
    throw failure(
        bad_usage, "usage",
        std::string(option) + " " + std::string(text) + ": expected " + std::string(wanted));
}

/// The finite number at the front of `text`, which loses it.
std::optional<double> take_number(std::string_view& text) {
    double value = 0.0;
    const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

}  // namespace

double parse_number(std::string_view option, std::string_view text) {
    std::string_view rest = text;
    const auto value = take_number(rest);
    if (!value || !rest.empty()) refuse(option, text, "a number");
    return *value;
}

double parse_volume(std::string_view option, std::string_view text) {
    const double value = parse_number(option, text);
    if (!(value >= 0.0)) refuse(option, text, "a volume, 0 or more");
    return value;
}

std::vector<double> parse_numbers(std::string_view option, std::string_view text,
                                  std::size_t count) {
    std::vector<double> values;
    std::string_view rest = text;
    while (values.size() < count) {
        const auto value = take_number(rest);
        if (!value) break;
        values.push_back(*value);
        if (values.size() == count || !rest.starts_with(',')) break;
        rest.remove_prefix(1);
    }
    if (values.size() != count || !rest.empty())
        refuse(option, text,
               count == 1 ? "a number" : std::to_string(count) + " numbers, separated by commas");
    return values;
}

tf::point3 parse_point(std::string_view option, std::string_view text) {
    const auto v = parse_numbers(option, text, 3);
    return {v[0], v[1], v[2]};
}

tf::point3 parse_direction(std::string_view option, std::string_view text) {
    const tf::point3 direction = parse_point(option, text);
    if (direction == tf::point3{})
        refuse(std::string(option) + " " + std::string(text) + ": has no direction");
    return direction;
}

std::string listed(std::span<const char* const> words) {
    std::string list;
    for (const char* word : words) list += (list.empty() ? "" : ", ") + std::string(word);
    return list;
}

std::size_t parse_choice(std::string_view option, std::string_view text,
                         std::span<const char* const> words) {
    std::string dashed(text);  // even_odd is the name in C++, C and Python
    std::ranges::replace(dashed, '_', '-');
    for (std::size_t i = 0; i < words.size(); ++i)
        if (dashed == words[i]) return i;
    refuse(option, text, "one of " + listed(words));
}

std::uint64_t parse_count(std::string_view option, std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        refuse(option, text, "a whole number, 0 or more");
    return value;
}

distance parse_distance(std::string_view option, std::string_view text) {
    std::string_view rest = text;
    const auto value = take_number(rest);
    const bool relative = rest == "%";
    if (!value || *value < 0.0 || !(rest.empty() || relative))
        refuse(option, text, "a distance such as 0.01, or a share of the diagonal such as 0.01%");
    return {std::string(text), relative ? *value / 100.0 : *value, relative};
}

double parse_share(std::string_view option, std::string_view text) {
    std::string_view rest = text;
    const auto value = take_number(rest);
    const double share = value ? *value / (rest == "%" ? 100.0 : 1.0) : -1.0;
    if (!(share >= 0.0 && share <= 1.0) || !(rest.empty() || rest == "%"))
        refuse(option, text, "a share such as 5% or 0.05");
    return share;
}

std::uint64_t parse_size(std::string_view option, std::string_view text) {
    constexpr std::string_view wanted = "a size in bytes such as 512M or 4G";
    constexpr std::string_view powers = "KMGT";
    std::string_view rest = text;
    const auto value = take_number(rest);
    if (!value || !(*value > 0.0)) refuse(option, text, wanted);
    double scale = 1.0;
    if (!rest.empty()) {
        const char letter =
            rest.front() >= 'a' ? static_cast<char>(rest.front() - 32) : rest.front();
        const std::size_t power = powers.find(letter);
        if (power == std::string_view::npos && rest != "B") refuse(option, text, wanted);
        if (power != std::string_view::npos) {
            scale = std::pow(1024.0, static_cast<double>(power + 1));
            rest.remove_prefix(1);
        }
        if (!rest.empty() && rest != "B" && rest != "b" && rest != "iB" && rest != "ib")
            refuse(option, text, wanted);
    }
    if (!(*value * scale >= 1.0) || !(*value * scale < 0x1p63)) refuse(option, text, wanted);
    return static_cast<std::uint64_t>(*value * scale);
}

double parse_seconds(std::string_view option, std::string_view text) {
    const double value = parse_number(option, text);
    if (!(value > 0.0)) refuse(option, text, "a number of seconds greater than 0");
    return value;
}

}  // namespace tools
