#pragma once
/// \file
/// Which names a pattern stands for.

#include <string_view>

namespace treeform::detail::assembly {

/// Whether `name` is what `pattern` says: `*` stands for any characters, also none, `?` for one.
/// \cost O(pattern times name)
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

}  // namespace treeform::detail::assembly
