#pragma once
/// \file
/// What tf-selfintersect says and writes.

#include "tools/shell/change_limits.hpp"
#include "tools/tf-selfintersect/search.hpp"
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

namespace tools {

/// "41 self-intersecting pairs of 26,306 faces: 41 crossing, in 3 regions".
[[nodiscard]] std::string verdict(const findings& result, const search_settings& settings);

/// What -v and -vv add to the verdict.
void say_details(job& work, const findings& result);

/// Enters the findings in `work.entry`; at most `limit` pairs are listed.
void enter_report(job& work, const findings& result, const search_settings& settings,
                  std::uint64_t limit);

/// All pairs as CSV: face,face,kind,region with the face numbers of the file, from 0.
void write_pairs(const job& work, const std::filesystem::path& path, const findings& result);

/// The curves as line segments: OBJ `v` and `l`, or PLY with an element `edge`.
void write_curves(const job& work, const std::filesystem::path& path, const findings& result);

/// Writes `file` with its faces marked (`tf::color_marks`), and enters that in `work.entry`.
void write_marked(job& work, tf::mesh_file& file, const findings& result,
                  const std::filesystem::path& path);

/// The findings as an HTML page, where one was asked for.
void write_page(job& work, const findings& result, const search_settings& settings);

/// By `resolve_mode`.
inline constexpr std::array<const char*, 3> repair_modes{"split", "outer", "remove"};

struct repair_settings {
    tf::resolve_mode mode = tf::resolve_mode::outer;
    tf::fill_rule fill_rule = tf::fill_rule::nonzero;
    tools::change_limits limits{};
    bool keep_cuts = false;
    bool keep_components = false;
    bool touching = false;  ///< faces that only touch are to be resolved, too
};

/// Repairs the mesh that was searched, enters "repair" and "output" in the report, says the verdict
/// and writes the result to `output`, if there is one and the result is as it has to be. `input` is
/// used up.
///
/// Whether it is. \throws failure
[[nodiscard]] bool repair_and_write(job& work, tf::mesh_file& input, const findings& result,
                                    const repair_settings& settings,
                                    const std::optional<std::filesystem::path>& output);

}  // namespace tools
