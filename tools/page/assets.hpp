#pragma once
/// \file
/// The style sheet and the script of pages; the build makes their texts from page.css and
/// viewer.js.

#include <string_view>

namespace tools {

extern const std::string_view page_css;
extern const std::string_view viewer_js;

}  // namespace tools
