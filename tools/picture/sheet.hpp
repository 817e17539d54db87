#pragma once
/// \file
/// A scene as one picture: a title, a pane for each view, the legend of the page.

#include "tools/picture/canvas.hpp"
#include "tools/picture/options.hpp"
#include "tools/picture/scene.hpp"

namespace tools {

/// The picture of a scene. Its colors, legend and title are those of the page; all panes have one
/// scale, which a bar shows. Below 320 x 240 there is no room for words, and none are drawn.
///
/// \cost O(V + F log F) a view, and O(width height) for a few surfaces behind each other
/// \same on any number of threads, and on any machine with IEEE arithmetic
[[nodiscard]] picture draw(const scene& shown, const picture_options& options = {});

}  // namespace tools
