#pragma once
/// \file
/// A picture as a PNG file.

#include "tools/picture/canvas.hpp"

#include <string>

namespace tools {

/// The bytes of the file: 8 bits a color, compressed. The same on any number of threads; another
/// version of zlib may pack the same pixels otherwise. \pre neither side is 0 or beyond 2^31
[[nodiscard]] std::string png(const picture& drawn);

}  // namespace tools
