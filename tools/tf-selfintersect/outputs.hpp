#pragma once
/// \file
/// What tf-selfintersect writes beside its verdict.

#include "tools/common/output_file.hpp"
#include "tools/tf-selfintersect/search.hpp"
#include <treeform/tf.hpp>

#include <cstdint>

namespace tools {

/// Enters the findings in `work.entry`; at most `limit` pairs are listed.
void enter_report(job& work, const findings& result, const search_settings& settings,
                  std::uint64_t limit);

/// All pairs as CSV: face,face,kind,region with the face numbers of the file, from 0.
void write_pairs(output_file& file, const findings& result);

/// The curves as line segments: OBJ `v` and `l`, or PLY with an element `edge`.
void write_curves(output_file& file, const findings& result, bool as_ply);

/// The mesh of `file` with its faces colored by the kind of pair they are in, and the properties
/// tf_class and tf_region. Enters what was written in `work.entry`.
void write_marked(job& work, tf::mesh_file& file, const findings& result,
                  const std::filesystem::path& path);

}  // namespace tools
