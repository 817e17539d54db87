#pragma once
/// \file
/// Fewer faces for a surface, within a distance that is proven both ways.
///
///     tf::simplify_result fewer = tf::simplify(scan, 0.05);

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

/// How to leave faces out.
struct simplify_options {
    /// Precision of points. With float32, all are rounded first, and bounds count that; values are
    /// stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    std::size_t target_faces = 0;  ///< stop at so many faces
    /// Edges whose faces turn by more degrees are features; 180: none.
    double feature_angle = 180.0;
    /// [F] or empty: edges between faces of different groups are borders of both.
    std::span<const std::uint32_t> face_groups{};
    /// [3 F] or empty: groups of corners. An edge is a seam, and so a border of both faces, unless
    /// their corners at each of its ends are of one group. Of a file: `carry_sources::corner_groups`.
    std::span<const std::uint32_t> corner_groups{};
    progress_callback progress{};
};

/// The mesh with fewer faces, and what was proven and checked.
struct simplify_result {
    static constexpr std::uint32_t none = operand_element::none;

    treeform::mesh mesh;
    std::vector<std::uint32_t> face_source;    ///< [F] the face of the input that each was
    std::vector<std::uint32_t> vertex_source;  ///< [V] vertex of the input that each is; none: new
    /// [V] of a new vertex, the face of the input that is nearest to it, on its side of seams; else
    /// none
    std::vector<std::uint32_t> face_of_new_vertex;
    /// [3 F] the corner of the input that each is at (3 f + i for corner i of face f), on its side of
    /// seams; none at new vertices
    std::vector<std::uint32_t> corner_source;
    std::uint64_t collapses = 0;            ///< edges that became a vertex
    std::uint64_t refused_by_topology = 0;  ///< edges tried whose collapse would change it
    std::uint64_t refused_by_turning = 0;   ///< edges whose collapse would turn a face about
    std::uint64_t refused_by_distance = 0;  ///< edges whose collapse was not proven near
    std::uint64_t refused_by_contact = 0;   ///< edges whose collapse would make faces meet
    double there_at_most = 0.0;             ///< no point of the input is further from the result
    double back_at_most = 0.0;              ///< no point of the result is further from the input
    /// Status ok: the result was looked at, and of what `find_solid_defects` counts nothing is more
    /// than it was. So a solid is one still. Else `not_certified`, or `cancelled`.
    treeform::certificate certificate{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const {
        if (!certificate) throw not_certified_error(certificate);
        return mesh;
    }
};

/// The mesh with fewer faces: edges are collapsed, those first that change the surface least.
///
/// Both surfaces are within `max_distance` of each other: each face is proven so, none is sampled.
/// No two faces are made to meet, exactly, on the coordinates returned; where faces of the input
/// meet, they are left to do so. A closed, oriented manifold stays one. What lies inside of what is
/// looked at in the end alone: the certificate says if that has changed.
///
/// Borders, and edges of features and groups, are simplified along themselves: of their vertices,
/// some stay, and they are within the distance of what they were, too. Where they end, branch or
/// cross, at edges of more than two faces or of faces that do not run both ways, and where faces at
/// a vertex are no fan, vertices stay as they are.
///
/// A distance below what doubles can prove, some 2^-46 of the largest coordinate, collapses
/// nothing, nor are coordinates whose squares are no doubles. Corners with equal coordinates are
/// one vertex; faces with two equal corners go, and are no part of either surface.
///
/// \throws std::invalid_argument for a distance that is negative or not finite, another number of
///         groups than of faces or corners, or a face with a corner that is out of range or not finite
/// \cost   50 to 150 microseconds a collapse, serial: O(n log n) for n collapses, more where a face
///         comes to stand for many; 1 kB a face; and `find_solid_defects` before and after
/// \same   on any number of threads
/// \source Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997
[[nodiscard]] TREEFORM_API simplify_result simplify(const mesh_ref& mesh, double max_distance,
                                                    const simplify_options& options = {});

}  // namespace treeform
