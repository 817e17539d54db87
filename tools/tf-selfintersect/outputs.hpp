#pragma once
/// \file
/// What tf-selfintersect says and writes.

#include "tools/tf-selfintersect/search.hpp"
#include <treeform/tf.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace tools {

/// "crossing", as in reports and CSV files.
[[nodiscard]] const char* name_of(tf::pair_kind kind);

/// The verdict: "41 self-intersecting pairs of 26,306 faces: 41 crossing, in 3 regions".
[[nodiscard]] std::string verdict(const findings& result, const search_settings& settings);

/// What -v and -vv add to the verdict.
void say_details(job& work, const findings& result);

/// The point half-way between the corners of the box of a region.
[[nodiscard]] tf::point3 center(const tf::intersection_region& region);

/// Enters the findings in `work.entry`; at most `limit` pairs are listed.
void enter_report(job& work, const findings& result, const search_settings& settings,
                  std::uint64_t limit);

/// All pairs as CSV: face,face,kind,region with the face numbers of the file, from 0.
void write_pairs(const job& work, const std::filesystem::path& path, const findings& result);

/// The curves as line segments: OBJ `v` and `l`, or PLY with an element `edge`.
void write_curves(const job& work, const std::filesystem::path& path, const findings& result);

/// The mesh of `file` with its faces colored by the kind of pair they are in, and the properties
/// tf_class and tf_region. Enters what was written in `work.entry`.
void write_marked(job& work, tf::mesh_file& file, const findings& result,
                  const std::filesystem::path& path);

/// The findings as an HTML page, where one was asked for.
void write_page(const job& work, const findings& result, const search_settings& settings);

}  // namespace tools
