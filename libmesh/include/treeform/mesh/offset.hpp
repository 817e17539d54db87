#pragma once
/// \file
/// Surfaces at a distance: solids grown, shrunk and hollowed; open surfaces given a thickness.
///
///     tf::offset_result shell = tf::hollow(solid, 2.0);
///
/// A closed surface around whatever there is.
///
///     tf::mesh solid = tf::wrap(mesh, 0.5).value();

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// How to make a surface at a distance. What an operation has no use for, it ignores.
struct offset_options {
    /// Edge of the cells that the surface is made in, in the mesh's length unit: at most half of
    /// the distance. Every point of space whose distance differs from the one asked for by more
    /// than twice this is on the right side of the surface. Details that are smaller may be lost.
    /// Not given: a quarter of the distance, at most a 64th of the diagonal of the result. Where
    /// that would make more than some 2^16 cells at the surface (170,000 faces), cells are larger,
    /// up to half of the distance. `offset_statistics` has the value used, and the error reached.
    std::optional<double> resolution{};
    /// `wrap`: how far the vertices of the wrap are from the mesh, in its length unit. Not given: a
    /// thirtieth of the size.
    std::optional<double> offset{};
    /// Precision of the coordinates returned. float32 values are stored as doubles.
    treeform::precision precision = treeform::precision::float64;
    progress_callback progress{};
};

/// What it took, and what was measured.
struct offset_statistics {
    double distance =
        0.0;  ///< that was asked for, without its sign; of `wrap`, how far its vertices are
    double resolution = 0.0;  ///< that was used; of `wrap`, its size
    /// Bounds of the distance from any point of the surface made, in its faces too, to the mesh
    /// that it is the offset of: all are in [least, greatest]. Found by branch and bound; each is
    /// within a sixteenth of the resolution of what is there. 0 where there is no surface, and of
    /// `wrap`.
    double least = 0.0;
    double greatest = 0.0;
    std::uint64_t cells = 0;  ///< that the surface may pass through
    /// Of `hollow`: cavities that nothing leads out of, those of the input, too.
    std::uint64_t sealed_cavities = 0;
    std::uint64_t points = 0;      ///< of `wrap`: of the tetrahedra that were made
    std::uint64_t tetrahedra = 0;  ///< of `wrap`: at the end
    std::uint64_t filled = 0;      ///< of `wrap`: tetrahedra filled so that it is a manifold
};

/// The mesh, and what was checked.
struct TREEFORM_API offset_result {
    treeform::mesh mesh;
    /// Status ok says, checked on the coordinates above: a closed manifold, outward, no two faces
    /// of which meet beyond common corners and edges. `open_input`: no solid was given, and `open`
    /// says where. `vanished`: nothing is left, as the solid is nowhere that thick, or by less than
    /// a cell.
    treeform::certificate certificate{};
    offset_statistics statistics{};
    /// Of `hollow`: numbers of drains that are not known to lead from outside into a cavity: an end
    /// of their axis is neither there nor there.
    std::vector<std::uint32_t> blind_drains{};

    /// The mesh.
    /// \throws not_certified_error unless the certificate's status is ok
    [[nodiscard]] const treeform::mesh& value() const&;
    [[nodiscard]] treeform::mesh value() &&;
};

/// The solid grown by `distance`, or shrunk where it is negative: all points inside or no further
/// from the surface than that; all points inside and no less far.
///
/// Outward, convex edges and corners become round; inward, they stay sharp in truth, but are cut
/// off by no more than a cell, as are all sharp edges of the result. The mesh has to bound a solid,
/// as an operand of `boolean`; where it meets itself, it is the solid that it winds around. What is
/// inside is decided exactly; vertices are at the distance to a thousandth of a cell or so.
///
/// \throws std::invalid_argument as `boolean`; for a distance that is 0 or not finite; for a
///         resolution that is not positive, more than half of the distance, finer than coordinates
///         of the precision tell apart, or so fine that there would be more than 2^22 cells: the
///         message names one that would do
/// \cost   O(A log F) for A cells, some area / resolution^2 times 3; 600 bytes a cell
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result offset(const mesh_ref& mesh, double distance,
                                                const offset_options& options = {});

/// A hole through the wall of a hollow solid.
struct drain {
    point3 at{};            ///< the point of the surface that is nearest to this is drilled
    double diameter = 0.0;  ///< a regular prism of 32 sides, whose corners are on this circle
};

/// The solid without what is further inside than `wall`: its surface stays bit for bit, around
/// cavities. Each drain runs through the wall along the shortest way to a cavity, and as far beyond
/// both ends as it is wide, but not more than half of the way to what is next there. `statistics`
/// are those of the cavities. `vanished` where there is none.
///
/// \throws std::invalid_argument as `offset`, for a wall that is not positive, and for a drain that
///         is not finite or whose diameter is not positive
/// \cost   as `offset` and `subtract`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result hollow(const mesh_ref& mesh, double wall,
                                                std::span<const drain> drains = {},
                                                const offset_options& options = {});

/// Where a thickness goes; the front is where faces are counter-clockwise.
enum class thick_side : std::uint8_t { both, front, back };

/// A solid around a surface, which may be anything: all points no further from it than half of
/// `thickness`. Its rim is round.
///
/// With `front` and `back` the surface is first moved to that side by half of the thickness, each
/// vertex so that planes of faces around it move that far, on average: exact where it is flat,
/// rounded where it bends. Sharp folds move by no more than twice that. `statistics` are of the
/// surface as moved. Faces have to agree in their orientation.
///
/// \throws std::invalid_argument as `offset`, with half of the thickness as the distance; for a
///         mesh without faces, or, of one side, naming a face that disagrees with its neighbor
/// \cost   as `offset`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API offset_result thicken(const mesh_ref& mesh, double thickness,
                                                 thick_side side = thick_side::both,
                                                 const offset_options& options = {});

/// A solid that holds all faces of `mesh`, whatever they are: open, crossing, turned any way, of
/// no area. A ball of diameter 2 `size` is rolled over them from outside, so to speak: it enters no
/// hole or gap that is narrower. So the wrap closes these, rounds what is sharp, and fills cavities
/// that nothing leads to. A smaller size follows the mesh more closely, with more faces, some
/// area / `size`^2 of them.
///
/// No face of the mesh meets the wrap, or is outside of it: that is decided exactly, on the
/// coordinates of both. The distance of its vertices is met as far as rounding allows.
///
/// \throws std::invalid_argument naming the face with a corner out of range or not finite; where
///         the mesh has no faces, where it is larger than 2^150 or smaller than 2^-150, for a
///         size or offset that is not positive and finite, or so small that coordinates of the
///         precision do not tell apart what is as near as the offset, or the wrap would have more
///         than 2^30 faces
/// \cost   for n points O(n log n) in most cases, O(n log F) queries of the tree over the faces;
///         some 400 bytes a point; serial
/// \same   on every machine
/// \source Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez, Alpha Wrapping with an
///         Offset, ACM TOG 41 (2022). Tetrahedra are cut out by their circumspheres only where that
///         keeps all of them oriented (`orient3d`), so that rounded circumspheres do no harm.
[[nodiscard]] TREEFORM_API offset_result wrap(const mesh_ref& mesh, double size,
                                              const offset_options& options = {});

}  // namespace treeform
