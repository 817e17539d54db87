#pragma once
/// \file
/// Numbers in sentences for people.

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace treeform::detail::base {

/// The number with six significant digits, or all digits before the decimal point if these are
/// more.
[[nodiscard]] inline std::string brief(double value) {
    char digits[32];
    const bool large = std::abs(value) >= 1e6 && std::abs(value) < 1e15;
    const auto form = large ? std::chars_format::fixed : std::chars_format::general;
    return {digits, std::to_chars(digits, digits + sizeof digits, value, form, large ? 0 : 6).ptr};
}

/// The shortest decimal text that reads back as `value`, for numbers that a user may enter again,
/// such as a limit.
[[nodiscard]] inline std::string shortest(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// 26306 edges as "26,306 edges".
[[nodiscard]] inline std::string counted(std::uint64_t n, const char* one, const char* several) {
    std::string text = std::to_string(n);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
    return text + " " + (n == 1 ? one : several);
}

}  // namespace treeform::detail::base
