#pragma once
/// \file
/// What a set operation is written to: the report and the mesh.

#include "tools/tf-boolean/settings.hpp"
#include "tools/tf-boolean/solids.hpp"
#include <treeform/tf.hpp>

namespace tools {

/// The keys of the report's file, each with nothing in it.
void enter_blank_report(job& work, const boolean_settings& settings);

/// The numbers that the result will be written as.
[[nodiscard]] tf::precision written_precision(const job& work, const std::vector<solid>& solids);

/// The facts of the result; an open one, or one of many pieces, has no volume.
void enter_result(job& work, const tf::boolean_result& result, bool bounds_solid);

/// The lines along which faces of the inputs meet each other or themselves, where asked for.
void write_curves(job& work, const boolean_settings& settings, const std::vector<solid>& solids);

/// Writes the surface, reads it again, and puts it in its place only if it is what was certified.
/// \throws failure (bad_output)
void write_surface(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                   tf::boolean_result& result);

}  // namespace tools
