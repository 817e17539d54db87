#pragma once
/// \file
/// The words of a picture: its title, legend, scale, and labels of things.

#include "tools/picture/canvas.hpp"
#include "tools/picture/drawing.hpp"
#include "tools/picture/scene.hpp"

#include <vector>

namespace tools {

/// Sizes of all words, for a picture of this size.
struct lettering {
    lettering(std::size_t width, std::size_t height);
    bool any = true;    ///< whether there is room for words
    double size = 0.0;  ///< of capitals, in pixels
    double margin = 0.0;
    double line = 0.0;  ///< from one line to the next
};

/// The height that the title needs above, and the legend below.
[[nodiscard]] double title_height(const scene& shown, const lettering& letters);
[[nodiscard]] double legend_height(const scene& shown, const lettering& letters, double width);

void draw_title(picture& on, const scene& shown, const lettering& letters);

/// Swatches with names and counts, the map, and a bar as long as it says: `pixels` are one unit of
/// the file.
void draw_legend(picture& on, const scene& shown, const lettering& letters, double pixels);

/// The name of a view in its corner, and the labels of things, those that are in the way of an
/// earlier one left out.
void draw_words(picture& on, const pane& at, const std::vector<drawn_label>& labels,
                const lettering& letters, const std::string& name);

}  // namespace tools
