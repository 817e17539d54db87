#pragma once
/// \file
/// Text as it can stand in an attribute of XML.

#include <string>
#include <string_view>

namespace treeform::detail::io {

/// UTF-8 in which nothing ends an attribute early: blanks for newlines and tabs; U+FFFD for bytes
/// that are no UTF-8 and for characters that XML cannot hold.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace treeform::detail::io
