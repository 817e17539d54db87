#pragma once
/// \file
/// A report as one HTML file that needs nothing else: words, tables, a 3D view.

#include "tools/page/scene.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// A color of faces in the view, with its box in the legend. The first one is of plain faces.
struct face_kind {
    std::string name;
    std::string color;        ///< "#rrggbb"
    std::uint64_t count = 0;  ///< shown behind the name; faces for plain ones, else pairs
};

struct table_cell {
    std::string text;
    bool number = false;
};

/// A row that one can fly to.
struct place_row {
    std::vector<table_cell> cells;
    tf::point3 low;
    tf::point3 high;
};

struct page {
    std::string title;
    std::string verdict;
    bool good = false;
    std::vector<face_kind> kinds;
    packed_scene scene;
    bool y_is_up = false;  ///< the view starts with z up otherwise
    std::vector<std::string> place_columns;
    std::vector<place_row> places;
    std::string places_note;
    std::vector<std::pair<std::string, std::string>> facts;
};

/// The text of the page, UTF-8. All texts are escaped here.
[[nodiscard]] std::string html(const page& contents);

/// `text` with what HTML gives a meaning replaced.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace tools
