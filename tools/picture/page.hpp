#pragma once
/// \file
/// A scene as one HTML file that needs nothing else: words, tables, a 3D view.

#include "tools/picture/scene.hpp"
#include <treeform/tf.hpp>

#include <string>
#include <string_view>

namespace tools {

/// The text of the page, UTF-8. Texts cannot break out of their places.
[[nodiscard]] std::string html(const scene& shown);

/// `text` with what HTML gives a meaning replaced.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace tools
