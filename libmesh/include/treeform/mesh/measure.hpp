#pragma once
/// \file
/// How two meshes lie to each other, how far they are apart, and where they are nearest.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/relation.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace treeform {

/// A point of a surface.
struct surface_point {
    std::uint32_t face = 0;
    point3 point{};  ///< rounded
    /// Weights of the corners of the face, each 0 or more, their sum 1, as rounded: those of the
    /// point of the face that they give best. Of a face without area, weights of two corners.
    std::array<double, 3> barycentric{1.0, 0.0, 0.0};
    friend bool operator==(const surface_point&, const surface_point&) = default;
};

struct measure_options {
    double radius = std::numeric_limits<double>::infinity();     ///< inclusive
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

struct mesh_measure {
    mesh_relation_result relation{};  ///< its status tells of both
    /// Not squared. 0 when the meshes touch or penetrate each other, and only then.
    double distance = 0.0;
    /// Exactly 0 if and only if a face of the one meets a face of the other: positive also for a
    /// mesh inside a solid that it does not touch.
    double surface_distance = 0.0;
    surface_point on_a{};  ///< nearest points of the surfaces; where they meet, a common one
    surface_point on_b{};
};

/// The relation of `a` and `b`, their distance and their nearest points in one; none when one has
/// no faces, or when they are further apart than `options.radius` and separate.
///
/// The relation is exact, as `relation` says, and so is whether distances are 0. Else they are
/// rounded as `distance` says. When the surfaces meet, the points are on the faces that
/// `relation` names if these meet.
///
/// \throws std::invalid_argument as `relation`, and for a radius that is negative or NaN
/// \cost   that of `distance`, and of `relation` where the boxes of the meshes meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_measure> measure(const prepared_mesh& a,
                                                               const prepared_mesh& b,
                                                               const measure_options& options = {});
[[nodiscard]] TREEFORM_API std::optional<mesh_measure> measure(mesh_view a, mesh_view b,
                                                               const measure_options& options = {});

/// The weights of the corners of `t` that give the point `p` of it, as in `surface_point`.
///
/// \pre coordinates are finite; `p` is on the triangle except for rounding, or else the weights are
///      those of some point of it
[[nodiscard]] TREEFORM_API std::array<double, 3> barycentric_weights(const std::array<point3, 3>& t,
                                                                     const point3& p);

}  // namespace treeform
