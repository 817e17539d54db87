#pragma once
/// \file
/// Paints a drawing, a tile at a time.

#include "tools/picture/drawing.hpp"

namespace tools {

/// Paints what `drawn` has within `box` of the picture: four samples a pixel, each with the surface
/// that is nearest to the eye, lit softly, with its contours. What was found shines faintly through
/// what hides it, and places too small to be seen have a halo.
///
/// Each sample asks which primitives it lies in; what is nearest wins, and of equals the lowest
/// number. Tiles ask the tree for theirs, and do not depend on each other.
///
/// \cost O(F + S D) for S samples and D surfaces behind each other
/// \same on any number of threads, and on any machine with IEEE arithmetic
void paint(picture& on, const drawing& drawn, const area& box);

}  // namespace tools
