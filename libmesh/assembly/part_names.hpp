#pragma once
/// \file
/// Matching of part names by patterns.

#include <string_view>

namespace treeform::detail::assembly {

/// Whether `name` matches `pattern`: `*` matches any number of characters, including none; `?`
/// matches one.
/// \cost O(length of `pattern` * length of `name`)
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

}  // namespace treeform::detail::assembly
