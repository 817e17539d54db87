#pragma once
/// \file
/// From a mesh with self-intersections to one without.

#include "tools/common/parse_value.hpp"
#include "tools/tf-selfintersect/search.hpp"
#include <treeform/mesh/resolve.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <filesystem>
#include <optional>

namespace tools {

struct repair_settings {
    tf::resolve_mode mode = tf::resolve_mode::outer;
    distance max_move{.given = "0.1%", .value = 1e-3, .relative = true};  ///< of any point
    bool keep_components = false;
    bool touching = false;  ///< faces that only touch are to be resolved, too
};

inline constexpr std::array<const char*, 3> repair_modes{"split", "outer", "remove"};
[[nodiscard]] const char* name_of(tf::resolve_mode mode);

/// Repairs the mesh that was searched, enters "repair" and "output" in the report, says the verdict
/// and writes the result to `output`, if there is one and the result is as it has to be. `input` is
/// used up.
///
/// Whether it is. \throws failure
[[nodiscard]] bool repair_and_write(job& work, tf::mesh_file& input, const findings& result,
                                    const repair_settings& settings,
                                    const std::optional<std::filesystem::path>& output);

}  // namespace tools
