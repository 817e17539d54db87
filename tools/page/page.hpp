#pragma once
/// \file
/// A scene as one HTML file that needs nothing else: words, tables, a 3D view.

#include "tools/common/run.hpp"
#include "tools/page/scene.hpp"
#include <treeform/tf.hpp>

#include <string>
#include <string_view>

namespace tools {

/// The text of the page, UTF-8. Texts cannot break out of their places.
[[nodiscard]] std::string html(const scene& shown);

/// `text` with what HTML gives a meaning replaced.
[[nodiscard]] std::string escaped(std::string_view text);

/// A scene with what all tools say of the job: the file, its digest, the program and its version.
[[nodiscard]] scene scene_of(const job& work, const char* tool);

/// Writes the page to where --html says. \throws failure (bad_output)
void write_page(const job& work, const scene& shown);

}  // namespace tools
