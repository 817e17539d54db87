#pragma once
/// \file
/// Solids cut by planes, in halves or in many pieces, each closed by caps. Parts of a mesh as
/// meshes of their own; meshes one after the other; meshes moved.
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
    /// As in `boolean_options`: how far what rounding has broken is joined.
    double max_displacement = std::numeric_limits<double>::infinity();
    /// Otherwise pieces end at the planes, and the mesh may end anywhere: it is cut as a surface.
    bool caps = true;
    /// Of a mesh that meets itself, as in `boolean_options`: where merging would mix values
    /// (`carry_sources::merging_mixes_values`), faces that were cut are to stay apart.
    bool keep_cuts = false;
    progress_callback progress{};
};

/// What is between two planes.
struct TREEFORM_API cut_piece {
    static constexpr std::uint32_t none = operand_element::none;

    treeform::mesh mesh;
    std::vector<std::uint32_t>
        face_source;  ///< [F] face of the input that each lies in; none: a cap
    std::vector<std::uint32_t> vertex_source;  ///< [V] vertex of the input that each is; none: new
    std::vector<std::uint32_t>
        cap;  ///< [F] of a cap, the number of its plane, from the lowest; else none
    /// Status ok says what it says of `boolean_result`; without caps, edges are not looked at. A
    /// piece without faces is ok, too: there is nothing between these planes.
    treeform::certificate certificate{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// Pieces, and what was checked.
struct cut_result {
    /// Of K planes, in their order along the normal, K + 1 pieces from the lowest up. None where
    /// the certificate says why.
    std::vector<cut_piece> pieces{};
    /// That of the first piece that is not ok, or of the mesh where it bounds no solid.
    treeform::certificate certificate{};
    /// Faces of the mesh met: what was cut is the solid that it winds around, where parts that
    /// overlap are one; without caps, the faces cut along each other. Not of `cut_along`.
    bool resolved = false;
};

/// The mesh below, between and above planes at `heights` above `plane`
/// (`oriented_plane::parallel`).
///
/// Which side of a plane a vertex is on is decided exactly, on the coordinates as given. A face
/// that lies in a plane belongs to the side that its solid is on. What the solid has in the plane
/// is then closed by a cap, the same for both sides. Only points on cuts are rounded, once; each
/// piece is checked as results of `boolean` are. Caps between axes stay flat and alike when
/// rounded; others may bend by a step of the precision.
///
/// `carry_sources` gives pieces the attributes of a file, by their sources, and
/// `carry_source::texture_caps` gives caps texture coordinates in their planes.
///
/// The mesh has to bound a solid, as an operand of `boolean` has to. Where it meets itself, or has
/// parts that are inside out or hidden in others, it is first made the solid that it winds around,
/// rounded: then all that is said here is of that one. Equal planes are one.
///
/// \throws std::invalid_argument as `section` and `boolean`
/// \cost   as `boolean` of the mesh with itself, and O(n log n) for the n faces that are cut; caps
///         of n points O(n^1.5)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API cut_result cut(const mesh_ref& mesh, const oriented_plane& plane,
                                          std::span<const double> heights,
                                          const cut_options& options = {});

/// Both halves: what is below the plane, and what is above.
[[nodiscard]] inline cut_result cut(const mesh_ref& mesh, const oriented_plane& plane,
                                    const cut_options& options = {}) {
    return cut(mesh, plane, std::array{0.0}, options);
}

/// Pieces that fit into a box of this size: cut by planes across x, then y, then z, as few along
/// each axis as there can be, and equally far apart, to rounding. A size that is infinite is not
/// cut along. Pieces are those with faces, by x, then y, then z; numbers of planes count across x
/// first, then y, then z. Cuts across y and z are of the rounded pieces of the cuts before.
///
/// \throws std::invalid_argument as `cut`, for a size that is not positive, or where there would be
///         more than 2^16 planes across an axis, or might be more than 2^20 pieces
[[nodiscard]] TREEFORM_API cut_result cut_to_fit(const mesh_ref& mesh, const point3& size,
                                                 const cut_options& options = {});

/// The mesh cut along its isolines (`isolines`): pieces with values below, between and from the
/// levels on, K + 1 for K levels in ascending order, equal ones counted once. Pieces are open
/// surfaces that end in the same points; together they are the mesh, for it is not moved: only new
/// points are rounded, by less than a step of their largest coordinate.
///
/// The certificate says whether faces meet beyond common corners and edges in what is returned, all
/// pieces together: where those of the mesh do, or rounding makes some do. `faces` of its pairs are
/// numbered through all pieces. Of `options`, `caps`, `precision` and `keep_cuts` do not count.
///
/// \throws std::invalid_argument as `isolines`
/// \cost   as `isolines` and `self_intersections`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API cut_result cut_along(const mesh_ref& mesh,
                                                std::span<const double> values,
                                                std::span<const double> levels,
                                                const cut_options& options = {});

/// Faces of a mesh by themselves, with the points that they use.
struct mesh_part {
    treeform::mesh mesh;
    std::vector<std::uint32_t> face_source;    ///< [F] the number of each face in the whole
    std::vector<std::uint32_t> vertex_source;  ///< [V] that of each point; ascending
    double volume = 0.0;                       ///< as `signed_volume`
    double area = 0.0;                         ///< as `surface_area`
};

/// The faces that corners link, as meshes, in the order of their lowest faces. Corners with equal
/// coordinates are one. A closed part that is inside out is a cavity, and goes with the smallest
/// closed part that it is in, if any. Volumes count without their sign, those of open parts as 0.
/// Parts with less than `min_volume`, in cubic units, are left out; `largest` parts of the greatest
/// volume are kept, of equal ones those of the greatest area; 0: all.
///
/// \pre    every coordinate of a corner is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range, and for a
///         `min_volume` that is negative or NaN
/// \cost   O(V + F); for cavities, as `contains`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_part> components(const mesh_ref& mesh,
                                                             double min_volume = 0.0,
                                                             std::size_t largest = 0);

/// The faces of these numbers, in this order, and the points that they use, in the order of `mesh`.
///
/// \throws std::invalid_argument naming the number that is no face of the mesh, or a face with a
///         corner out of range
/// \cost   O(V + F)
[[nodiscard]] TREEFORM_API mesh_part submesh(const mesh_ref& mesh,
                                             std::span<const std::uint32_t> faces);

/// Points and faces of all meshes, one after the other; nothing is joined.
///
/// \throws std::length_error for more points or faces than 32 bits can number
[[nodiscard]] TREEFORM_API mesh concatenate(const mesh_refs& meshes);

/// The mesh with its points moved. Where `by` mirrors, faces are turned over, so that they look
/// outward as before.
[[nodiscard]] TREEFORM_API mesh transform_mesh(const mesh_ref& mesh, const transform<3>& by);

}  // namespace treeform
