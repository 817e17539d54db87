#pragma once
/// \file
/// The style sheet and the script of pages: the build makes their texts from
/// tools/picture/viewer/viewer.css and viewer.min.js.

#include <string_view>

namespace tools {

extern const std::string_view viewer_css;
extern const std::string_view viewer_js;

}  // namespace tools
