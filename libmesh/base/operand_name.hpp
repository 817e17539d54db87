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

}  // namespace treeform::detail::base
