#pragma once
/// \file
/// What becomes of a set operation: the report, the mesh, and the outcome in words.

#include "tools/tf-boolean/settings.hpp"
#include "tools/tf-boolean/solids.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <string>
#include <vector>

namespace tools {

/// The keys of the report's file, each with nothing in it.
void enter_blank_report(job& work, const boolean_settings& settings);

/// The numbers that the result will be written as.
[[nodiscard]] tf::precision written_precision(const job& work, const std::vector<solid>& solids);

[[nodiscard]] inline bool is_stl(const common_options& o) {
    return !o.output.empty() && mesh_format(o, o.output) == "stl";
}

/// The facts of the result; an open one, or one of many pieces, has no volume.
void enter_result(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                  const tf::boolean_result& result, bool bounds_solid);

/// All inputs as one mesh, and its faces that meet. \throws failure (stopped)
struct meetings {
    tf::mesh joined{};
    std::vector<tf::face_pair> pairs{};
};
[[nodiscard]] meetings meetings_of(job& work, const std::vector<solid>& solids);

/// Page and picture, where they are asked for: the result by the inputs that its faces come from,
/// or the inputs alone and where they are open.
void write_page(job& work, const std::vector<solid>& solids, const std::string& verdict, bool good,
                const tf::boolean_result* made = nullptr);

/// The lines along which faces of the inputs meet each other or themselves, where asked for.
void write_curves(job& work, const boolean_settings& settings, const std::vector<solid>& solids);

/// Writes the surface, reads it again, and puts it in its place only if it is what was certified.
/// \throws failure (bad_output)
void write_surface(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                   tf::boolean_result& result);

/// "union: 1,234 faces, volume 1.875, moved by 1.1e-16 at most"
[[nodiscard]] std::string verdict(const job& work, const boolean_settings& settings,
                                  const tf::boolean_result& result);

/// What users may trip over.
void warn_of_surprises(job& work, const boolean_settings& settings,
                       const std::vector<solid>& solids, const tf::boolean_result& result);

/// Why nothing is written, and what may help.
void warn_of_failure(job& work, const tf::boolean_result& result, const std::string& remedy);

/// What -v adds.
void say_details(job& work, const tf::boolean_result& result);

}  // namespace tools
