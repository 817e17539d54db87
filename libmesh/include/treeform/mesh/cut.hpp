#pragma once
/// \file
/// Solids cut by planes into halves or pieces, closed by caps. Parts of a mesh, concatenated
/// meshes, and transformed meshes.
///
///     tf::cut_result halves = tf::cut(solid, {{0, 0, 5}, {0, 0, 1}});

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform {

/// How to cut.
struct cut_options {
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    /// As in `boolean_options`.
    double max_displacement = std::numeric_limits<double>::infinity();
    /// Close pieces by caps. If false, the mesh is cut as a surface, which may be open, and pieces
    /// are open at the planes.
    bool caps = true;
    /// As in `boolean_options`, for a mesh that meets itself. Set it if merging would mix values
    /// (`attribute_sources::merging_mixes_values`).
    bool keep_cuts = false;
    progress_callback progress{};
};

/// The part of the mesh between two neighboring planes.
struct TREEFORM_API cut_piece {
    static constexpr std::uint32_t none = operand_element::none;

    treeform::mesh mesh;
    std::vector<std::uint32_t>
        face_source;  ///< [F] input face that contains each face; none: a cap
    std::vector<std::uint32_t> vertex_source;  ///< [V] input vertex equal to each vertex; none: new
    std::vector<std::uint32_t>
        cap;  ///< [F] for faces of a cap, the number of its plane (0: the lowest); else none
    /// Status ok means the same as in `boolean_result`; without caps, edges are not checked. A
    /// piece without faces is ok: the mesh has no part between these planes.
    treeform::certificate certificate{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The pieces, and their certificate.
struct cut_result {
    /// For K planes, K + 1 pieces in order along the normal, from the lowest up. Empty if the mesh
    /// cannot be cut; the certificate has the reason.
    std::vector<cut_piece> pieces{};
    /// The certificate of the first piece that is not ok, or of the mesh if it bounds no solid.
    treeform::certificate certificate{};
    /// True if faces of the mesh meet. Then the solid that the mesh winds around was cut, with
    /// overlapping parts merged; without caps, the mesh with its faces cut along each other. Not
    /// used by `cut_along`.
    bool resolved = false;
};

/// The pieces of a mesh below, between and above planes at `heights` above `plane`
/// (`oriented_plane::parallel`).
///
/// The side of each vertex is decided exactly, on the coordinates as given. A face in a plane
/// belongs to the piece that it bounds. The section of the solid in a plane becomes a cap, the same
/// on both sides. Only points on cuts are rounded, once; each piece is checked like a result of
/// `boolean`. Caps perpendicular to an axis stay flat and equal when rounded; others may bend by a
/// unit in the last place.
///
/// `attribute_sources` transfers the attributes of a file to pieces.
/// `attribute_source::texture_caps` gives caps planar texture coordinates.
///
/// With caps, the mesh must bound a solid, like an operand of `boolean`. If it meets itself, or has
/// parts that are inside out or hidden in others, it is first replaced by the solid that it winds
/// around, rounded; the statements above then hold for that solid. Equal planes count once.
///
/// \throws std::invalid_argument as `section` and `boolean`
/// \cost   as `boolean` of the mesh with itself, and O(n log n) for the n faces that are cut; caps
///         of n points O(n^1.5)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API cut_result cut(const mesh_ref& mesh, const oriented_plane& plane,
                                          std::span<const double> heights,
                                          const cut_options& options = {});

/// Both halves: the part below the plane, then the part above.
[[nodiscard]] inline cut_result cut(const mesh_ref& mesh, const oriented_plane& plane,
                                    const cut_options& options = {}) {
    return cut(mesh, plane, std::array{0.0}, options);
}

/// Pieces that fit into a box of this size. They are cut by planes perpendicular to x, then y, then
/// z: as few as possible for each axis, equally spaced up to rounding, and none for an axis with
/// infinite size. Pieces without faces are omitted; the others are ordered by x, then y, then z.
/// Planes are numbered in the same order. Later cuts cut the rounded pieces of earlier ones.
///
/// \throws std::invalid_argument as `cut`; for a size that is not positive; for more than 2^16
///         planes for an axis, or possibly more than 2^20 pieces
[[nodiscard]] TREEFORM_API cut_result cut_to_fit(const mesh_ref& mesh, const point3& size,
                                                 const cut_options& options = {});

/// The mesh cut along its isolines (`isolines`): K + 1 pieces for K different levels in ascending
/// order. A piece has the values from one level, inclusive, to the next. Pieces are open surfaces
/// with common border points, and together cover the mesh. Only new points are rounded, by less
/// than a step of their largest coordinate.
///
/// The certificate is that of all pieces together. It lists faces that meet beyond common corners
/// and edges, because faces of the mesh do, or by rounding. Its face numbers count through all
/// pieces. `caps`, `precision` and `keep_cuts` of `options` are ignored.
///
/// \throws std::invalid_argument as `isolines`
/// \cost   as `isolines` and `self_intersections`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API cut_result cut_along(const mesh_ref& mesh,
                                                std::span<const double> values,
                                                std::span<const double> levels,
                                                const cut_options& options = {});

/// A subset of the faces of a mesh, with the points that they use.
struct mesh_part {
    treeform::mesh mesh;
    std::vector<std::uint32_t> face_source;  ///< [F] the number of each face in the given mesh
    /// [V] the number of each point in the given mesh; ascending
    std::vector<std::uint32_t> vertex_source;
    double volume = 0.0;  ///< as `signed_volume`
    double area = 0.0;    ///< as `surface_area`
};

/// The connected components of a mesh (faces linked by common corners), in the order of their
/// lowest faces. Corners with equal coordinates are one. A closed component that is inside out is a
/// cavity; it is returned with the smallest closed component around it, if any. Parts with a volume
/// below `min_volume`, in cubic units, are omitted; for this, volumes have no sign, and those of
/// open parts are 0. If `largest` is not 0, only that many parts are returned: those of the
/// greatest volume and, for equal volumes, the greatest area.
///
/// \pre    every coordinate of a corner is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range, and for a
///         `min_volume` that is negative or NaN
/// \cost   O(V + F); with cavities, plus `contains`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_part> components(const mesh_ref& mesh,
                                                             double min_volume = 0.0,
                                                             std::size_t largest = 0);

/// The faces with these numbers, in this order, and the points that they use, in the order of
/// `mesh`.
///
/// \throws std::invalid_argument naming a number that is out of range, or a face with a corner out
///         of range
/// \cost   O(V + F)
[[nodiscard]] TREEFORM_API mesh_part submesh(const mesh_ref& mesh,
                                             std::span<const std::uint32_t> faces);

/// The points and faces of all meshes, one mesh after the other; points are not joined.
///
/// \throws std::length_error for more points or faces than 32 bits can number
[[nodiscard]] TREEFORM_API mesh concatenate(const mesh_refs& meshes);

/// The mesh with transformed points. If `by` mirrors, faces are flipped, so that they still point
/// outward.
[[nodiscard]] TREEFORM_API mesh transform_mesh(const mesh_ref& mesh, const transform<3>& by);

}  // namespace treeform
