#pragma once
/// \file
/// From a file's mesh to its classified self-intersections.

#include "tools/shell/parse_value.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <set>

namespace tools {

struct search_settings {
    bool touching = false;
    bool no_coplanar = false;
    bool between = false;
    bool within = false;
    bool first = false;
    std::optional<tf::vertex_identity> vertices{};  ///< none: by format
    distance tolerance{};
    std::optional<tf::box3> box{};

    /// The kinds of pairs that make the mesh self-intersecting.
    [[nodiscard]] tf::pair_kinds counted() const;
    /// Those that are looked for at all.
    [[nodiscard]] tf::pair_kinds looked_for() const;
};

struct findings {
    tf::usable_mesh part{};        ///< what was searched
    tf::face_pair_result found{};  ///< only pairs that count; all counts
    std::vector<tf::intersection_region> regions{};
    tf::face_marks marks{};
    std::optional<tf::box3> box{};  ///< of all finite points
    std::uint64_t faces_stored = 0;
    std::uint64_t triangles = 0;
    std::uint64_t searched = 0;  ///< triangles; of a search in tiles, more than `part` has
    std::uint64_t points_stored = 0;
    double tolerance_used = 0.0;

    [[nodiscard]] double diagonal() const { return box ? box->diagonal() : 0.0; }
    [[nodiscard]] std::uint32_t region_of(const tf::face_pair& pair) const {
        return static_cast<std::uint32_t>(marks.region[pair.a]);
    }
    /// Empty where none were asked for.
    [[nodiscard]] std::set<std::uint32_t> components_of(const tf::intersection_region& r) const;
};

/// Looks for self-intersections in `file`, whose mesh is used up unless `keep_mesh`.
/// \throws failure (bad_input) when there is no triangle to look at; (stopped) when stopped
[[nodiscard]] findings search(job& work, tf::mesh_file& file, const search_settings& settings,
                              bool keep_mesh);

/// Leaves only pairs that count, groups them, and marks their faces.
void group_findings(job& work, findings& result, const search_settings& settings);

/// Warns of points next to others that are not equal; with a -t that closes the surface, if any.
void hint_at_near_points(job& work, const findings& result);

}  // namespace tools
