#pragma once
/// \file
/// The findings in words, for the terminal and for pages.

#include "tools/tf-selfintersect/search.hpp"
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <string>

namespace tools {

/// "crossing", as in reports and CSV files.
[[nodiscard]] const char* name_of(tf::pair_kind kind);

/// The verdict: "41 self-intersecting pairs of 26,306 faces: 41 crossing, in 3 regions".
[[nodiscard]] std::string verdict(const findings& result, const search_settings& settings);

/// What -v and -vv add to the verdict.
void say_details(job& work, const findings& result);

/// "(0, 0, 1.5)"
[[nodiscard]] std::string in_words(const tf::point3& p);

/// The point half-way between the corners of the box of a region.
[[nodiscard]] tf::point3 center(const tf::intersection_region& region);

}  // namespace tools
