#pragma once
/// \file
/// A scene as one picture: a title, a pane for each view, the legend of the page.

#include "tools/picture/canvas.hpp"
#include "tools/picture/scene.hpp"
#include "tools/picture/view.hpp"

#include <string>

namespace tools {

/// The picture of a scene. Its colors, legend and title are those of the page; all panes have one
/// scale, which a bar shows. Below 320 x 240 there is no room for words, and none are drawn.
///
/// \cost O(V + F log F) a view, and O(width height) for a few surfaces behind each other
/// \same on any number of threads, and on any machine with IEEE arithmetic
[[nodiscard]] picture draw(const scene& shown, const picture_options& options = {});

/// The bytes of the file: 8 bits a color, compressed. The same on any number of threads; another
/// version of zlib may pack the same pixels otherwise. \pre neither side is 0 or beyond 2^31
[[nodiscard]] std::string png(const picture& drawn);

}  // namespace tools
