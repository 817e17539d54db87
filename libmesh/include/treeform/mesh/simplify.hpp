#pragma once
/// \file
/// Edge collapse within a distance that is proven in both directions.
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

/// How to simplify.
struct simplify_options {
    /// Precision of the returned points. With float32, all points are rounded first, and the bounds
    /// include this; values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    std::size_t target_faces = 0;  ///< stop at this number of faces
    /// Edges are features if the normals of their faces differ by more than this, in degrees; 180:
    /// none.
    double feature_angle = 180.0;
    /// [F] or empty: edges between faces of different groups are borders of both.
    std::span<const std::uint32_t> face_groups{};
    /// [3 F] or empty: groups of corners. An edge is a seam, and so a border of both faces, unless
    /// at each end the corners of both faces are in one group. `attribute_sources::corner_groups`
    /// has the groups of a file.
    std::span<const std::uint32_t> corner_groups{};
    progress_callback progress{};
};

/// The simplified mesh, proven distances, and its certificate.
struct simplify_result {
    static constexpr std::uint32_t none = operand_element::none;

    treeform::mesh mesh;
    std::vector<std::uint32_t> face_source;    ///< [F] the input face of each face
    std::vector<std::uint32_t> vertex_source;  ///< [V] input vertex equal to each vertex; none: new
    /// [V] for a new vertex, the nearest input face on its side of seams; else none
    std::vector<std::uint32_t> face_of_new_vertex;
    /// [3 F] for each corner, an input corner (3 f + i for corner i of face f) at its vertex, on
    /// the same side of seams; none at new vertices
    std::vector<std::uint32_t> corner_source;
    std::uint64_t collapses = 0;       ///< edges collapsed
    std::uint64_t fixed_vertices = 0;  ///< vertices on nonmanifold edges or fans, never removed
    std::uint64_t refused_by_topology = 0;  ///< edges whose collapse would change the topology
    std::uint64_t refused_by_turning = 0;   ///< edges whose collapse would turn a face too far
    /// Edges whose collapse was not proven within the distance.
    std::uint64_t refused_by_distance = 0;
    std::uint64_t refused_by_contact = 0;  ///< edges whose collapse would make faces meet
    /// Bound of the distance from any input point to the result.
    double input_to_result_bound = 0.0;
    /// Bound of the distance from any point of the result to the input.
    double result_to_input_bound = 0.0;
    /// Status ok means no worse than the input: no count of `find_solid_defects` is larger. A solid
    /// is still a solid; faces that met may still meet. Otherwise `not_certified` or `cancelled`.
    treeform::certificate certificate{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const {
        if (!certificate) throw not_certified_error(certificate);
        return mesh;
    }
};

/// The mesh with fewer faces, by edge collapses in the order of their quadric error.
///
/// Input and result are within `max_distance` of each other: this is proven for each face, not
/// sampled. No collapse makes faces meet, exactly, on the coordinates returned; faces of the input
/// that meet may still meet. A closed, oriented manifold remains a closed, oriented manifold. The
/// nesting of components is only checked at the end, in the certificate.
///
/// Borders, features, and borders of groups are simplified as polylines, within the same distance:
/// vertices on them are removed, but not moved. Vertices stay where such lines end, branch or
/// cross, at nonmanifold or inconsistently oriented edges, and where their faces are not one fan.
///
/// Nothing is collapsed if the distance is below about 2^-46 of the largest coordinate, which
/// doubles cannot prove, or if squares of coordinates overflow or underflow. Corners with equal
/// coordinates are one vertex; faces with two equal corners are dropped, and distances do not take
/// them into account.
///
/// \throws std::invalid_argument for a distance that is negative or not finite, for a number of
///         groups other than that of faces or corners; naming a face with a corner that is out of
///         range or not finite
/// \cost   O(n log n) for n collapses, 50 to 150 microseconds each, serial; more if a face replaces
///         many; 1 kB a face; plus `find_solid_defects` before and after
/// \same   on any number of threads
/// \source Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997
[[nodiscard]] TREEFORM_API simplify_result simplify(const mesh_ref& mesh, double max_distance,
                                                    const simplify_options& options = {});

}  // namespace treeform
