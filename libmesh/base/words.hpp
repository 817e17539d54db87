#pragma once
/// \file
/// Numbers in sentences for people.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>

namespace treeform::detail::base {

/// The shortest decimal text that reads back as `value`.
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
