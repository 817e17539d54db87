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

/// For messages: "operand b"; beyond the third, where letters must be counted, "operand 31 (ae)".
[[nodiscard]] inline std::string operand_in_words(std::size_t operand) {
    const std::string name = operand_name(operand);
    return "operand " + (operand < 3 ? name : std::to_string(operand + 1) + " (" + name + ")");
}

}  // namespace treeform::detail::base
