#pragma once
/// \file
/// The names of operands in formulas and messages.

#include <cstddef>
#include <string>

namespace treeform::detail::base {

/// "a" ... "z", "aa", "ab", ...: the name of operand 0, 1, ... in a `boolean_expression`.
[[nodiscard]] inline std::string operand_name(std::size_t operand) {
    std::string name;
    for (std::size_t rest = operand + 1; rest > 0; rest = (rest - 1) / 26)
        name.insert(name.begin(), static_cast<char>('a' + (rest - 1) % 26));
    return name;
}

/// For messages: "operand b"; beyond the third, where letters must be counted, "operand ae (the
/// 31st)".
[[nodiscard]] inline std::string operand_in_words(std::size_t operand) {
    const std::string name = "operand " + operand_name(operand);
    if (operand < 3) return name;
    const std::size_t rank = operand + 1, last = rank / 10 % 10 == 1 ? 0 : rank % 10;
    const char* const ending = last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
    return name + " (the " + std::to_string(rank) + ending + ")";
}

}  // namespace treeform::detail::base
