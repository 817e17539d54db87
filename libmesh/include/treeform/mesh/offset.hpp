#pragma once
/// \file
/// Offset surfaces: solids grown, shrunk and hollowed; surfaces thickened.
///
///     tf::offset_result shell = tf::hollow(solid, 2.0, {.drains = {{{0, 0, 5}, 1.0}}});
///
/// Alpha wrapping: a closed surface around any mesh.
///
///     tf::mesh solid = tf::wrap(mesh, 0.5).value();

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace treeform {

/// Options of `offset`, `hollow`, `thicken` and `wrap`. Each function ignores those that do not
/// concern it.
struct offset_options {
    /// Edge length of the cells from which the surface is made, in the mesh's length unit; at most
    /// half of the distance. Every point whose distance differs from the given one by more than
    /// twice the resolution is on the right side of the surface. Smaller details may be lost.
    /// Default: a quarter of the distance, at most 1/64 of the diagonal of the result; larger, up
    /// to half of the distance, if there would be more than about 2^16 cells at the surface
    /// (170,000 faces). `offset_result` has the value used, and the error.
    std::optional<double> resolution{};
    /// `wrap`: the distance of the wrap's vertices from the mesh, in its length unit. Default: a
    /// thirtieth of `size`.
    std::optional<double> offset{};
    /// `thicken`: distance by which the surface is first moved toward its front, in its length
    /// unit; if negative, toward its back. With half of the thickness, the input surface becomes
    /// the back of the solid.
    double shift = 0.0;
    /// `hollow`: holes through the wall, a point and a diameter each: `{{{0, 0, 5}, 2}}`.
    std::vector<std::pair<point3, double>> drains{};
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    progress_callback progress{};
};

/// The mesh, and its certificate.
struct TREEFORM_API offset_result {
    treeform::mesh mesh;
    /// Status ok means, verified on the coordinates of `mesh`: a closed manifold, oriented outward,
    /// whose faces meet only in common corners and edges. `open_input`: the input bounds no solid;
    /// `open_edges` lists where. `vanished`: the result is empty, since the solid is nowhere thick
    /// enough, or exceeds that thickness by less than a cell.
    treeform::certificate certificate{};
    double distance = 0.0;    ///< the given distance, without its sign; for `wrap`, the offset used
    double resolution = 0.0;  ///< the resolution used; for `wrap`, its `size`
    /// Lower bound of the distance from any point of the new surface, also inside its faces, to the
    /// input surface. For `hollow`, the new surface is the surface of the cavities; for `thicken`,
    /// the distance is to the moved surface. By branch and bound: this and `greatest_distance` are
    /// within a sixteenth of the resolution of the true extremes. 0 if there is no surface, and for
    /// `wrap`.
    double least_distance = 0.0;
    double greatest_distance = 0.0;  ///< upper bound of the same distances
    std::uint64_t cells = 0;         ///< cells that the surface may pass through
    /// For `hollow`: number of cavities without an opening, including those of the input.
    std::uint64_t sealed_cavities = 0;
    /// For `hollow`: numbers of drains that do not lead from outside into a cavity, judged by the
    /// ends of their axes.
    std::vector<std::uint32_t> blind_drains{};
    std::uint64_t tetrahedra = 0;         ///< for `wrap`: tetrahedra at the end
    std::uint64_t tetrahedra_points = 0;  ///< for `wrap`: points of the tetrahedra
    /// for `wrap`: tetrahedra filled to make the surface manifold
    std::uint64_t filled_tetrahedra = 0;

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The solid grown by `distance`: points inside, or at most this far from the surface. If negative,
/// the solid shrunk: points inside, and at least |distance| from the surface.
///
/// Convex edges and corners become round outward. Edges that the exact offset keeps sharp are cut
/// off by at most a cell. The mesh must bound a solid, like an operand of `boolean`; if it meets
/// itself, the solid that it winds around is used. What is inside is decided exactly. Vertices are
/// at the given distance, up to about a thousandth of a cell.
///
/// \throws std::invalid_argument as `boolean`; for a distance that is 0 or not finite; for a
///         resolution that is not positive, more than half of the distance, below the spacing of
///         the coordinates, or so fine that there would be more than 2^22 cells: the message names
///         a sufficient one
/// \cost   O(A log F) for A cells, about 3 area / resolution^2; 600 bytes a cell
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result offset(const mesh_ref& mesh, double distance,
                                                const offset_options& options = {});

/// Hollows the solid: its points deeper inside than `wall` become cavities; the outer surface stays
/// bit for bit. The cavities are made of flat faces, so the wall may be thinner than given:
/// `offset_result::least_distance` is a lower bound. The status is `vanished` if there is no
/// cavity.
///
/// `drains` are holes through the wall: a point and a diameter. Each runs from the point of the
/// surface nearest to the given one, along the shortest segment to a cavity. It is a regular prism
/// of 32 sides; the diameter is that of the circle through its corners. It extends beyond both ends
/// by its diameter, but at most half of the way to the next surface.
///
/// \throws std::invalid_argument as `offset`; for a wall that is not positive; for a drain that is
///         not finite, or with a diameter that is not positive
/// \cost   as `offset` and `difference`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result hollow(const mesh_ref& mesh, double wall,
                                                const offset_options& options = {});

/// A solid around any surface: all points at most half of `thickness` away. Its rim is round.
///
/// With a `shift`, the surface is first moved toward its front, the side from which faces are seen
/// counter-clockwise. Each vertex moves so that the planes of its faces move by the shift, on
/// average. This is exact where the surface is flat; where it bends, it becomes rounder. Vertices
/// of sharp folds move by at most twice the shift. Faces must be consistently oriented.
///
/// \throws std::invalid_argument as `offset`, with half of the thickness as the distance; for a
///         mesh without faces; for a shift that is not finite; with a shift, naming a face that is
///         inconsistent with its neighbor
/// \cost   as `offset`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result thicken(const mesh_ref& mesh, double thickness,
                                                 const offset_options& options = {});

/// Alpha wrapping: a solid that contains all faces of `mesh`, which may be open, intersecting,
/// inconsistently oriented or degenerate. The wrap is the surface that a ball of radius `size`
/// cannot pass when rolled over the mesh from outside: holes and gaps narrower than the ball are
/// closed, sharp edges are rounded, and cavities without an opening for the ball are filled. A
/// smaller size follows the mesh more closely, with more faces: about area / `size`^2.
///
/// No face of the mesh meets the wrap or is outside of it: this is verified exactly, on the
/// coordinates of both. The wrap's vertices are at the offset from the mesh, up to rounding.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite; for a mesh
///         without faces, larger than 2^150 or smaller than 2^-150; for a size or offset that is
///         not positive and finite; for an offset near the spacing of the coordinates; for a wrap
///         of more than 2^30 faces
/// \cost   O(n log n) for n points in most cases, with O(n) queries of a tree over the F faces;
///         about 400 bytes a point; serial
/// \same   on every machine
/// \source Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez, Alpha Wrapping with an
///         Offset, ACM TOG 41 (2022). The cavity of a new point has only tetrahedra that keep all
///         new ones positively oriented (`orient3d`), so that rounded circumspheres do no harm.
[[nodiscard]] TREEFORM_API offset_result wrap(const mesh_ref& mesh, double size,
                                              const offset_options& options = {});

}  // namespace treeform
