#pragma once
/// \file
/// From a file's mesh to its classified self-intersections.

#include "tools/common/parse_value.hpp"
#include "tools/common/run.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace tools {

enum class vertex_mode { by_format, stored, equal };

struct search_settings {
    bool touching = false;
    bool no_overlap = false;
    bool between = false;
    bool within = false;
    bool first = false;
    vertex_mode vertices = vertex_mode::by_format;
    distance tolerance{};
    std::optional<tf::box3> box{};

    /// Whether pairs of this kind make the mesh self-intersecting.
    [[nodiscard]] bool counts(tf::pair_kind kind) const;
    /// Whether pairs of this kind are looked for at all.
    [[nodiscard]] bool looks_for(tf::pair_kind kind) const;
};

/// What was found. Faces of `mesh` and of the pairs are triangles of the search; `stored_face`
/// takes them back to the file.
struct findings {
    tf::mesh mesh{};  ///< what was searched: finite, corners joined, cut down to the box
    std::vector<std::uint32_t> triangle_of_face{};         ///< in the file's mesh; empty: the same
    std::vector<std::uint32_t> stored_face_of_triangle{};  ///< in the file; empty: the same
    std::vector<std::uint32_t> component{};  ///< [F] of the whole mesh; empty: none was asked for
    tf::self_intersection_result found{};    ///< only pairs that count; all counts
    tf::intersection_regions regions{};
    std::optional<tf::box3> box{};  ///< of all finite points
    std::uint64_t faces_stored = 0;
    std::uint64_t triangles = 0;
    std::uint64_t points_stored = 0;
    std::optional<std::uint64_t> points_distinct{};
    std::uint64_t non_finite = 0;  ///< triangles left out
    std::uint64_t degenerate = 0;  ///< triangles that are a segment or a point
    double tolerance_used = 0.0;
    std::uint64_t corners_joined = 0;  ///< by the tolerance, beyond equal ones

    [[nodiscard]] std::uint32_t triangle(std::uint32_t face) const {
        return triangle_of_face.empty() ? face : triangle_of_face[face];
    }
    [[nodiscard]] std::uint32_t stored_face(std::uint32_t face) const {
        const std::uint32_t t = triangle(face);
        return stored_face_of_triangle.empty() ? t : stored_face_of_triangle[t];
    }
    [[nodiscard]] std::uint64_t pairs_that_count() const { return found.pairs.size(); }
    /// Faces in at least one pair, ascending.
    [[nodiscard]] std::vector<std::uint32_t> faces_hit() const;
};

/// Looks for self-intersections in `file`, whose mesh is used up unless `keep_mesh`.
/// \throws failure (bad_input) when there is no triangle to look at; (stopped) when stopped
[[nodiscard]] findings search(job& work, tf::mesh_file& file, const search_settings& settings,
                              bool keep_mesh);

/// How many points lie within a millionth of the diagonal of another one without being equal to
/// it, and that distance; none when this would take long to find out.
struct near_points {
    std::uint64_t count = 0;
    double within = 0.0;
};
[[nodiscard]] std::optional<near_points> nearly_equal_points(const findings& result);

}  // namespace tools
