#pragma once
/// \file
/// Text for an attribute of XML.

#include <string>
#include <string_view>

namespace treeform::detail::io {

/// Valid UTF-8 for an attribute, escaped: blanks for newlines and tabs; U+FFFD for bytes that are
/// not UTF-8, and for characters that XML does not allow.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace treeform::detail::io
