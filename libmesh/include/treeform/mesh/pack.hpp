#pragma once
/// \file
/// Lays a mesh on a bed with a flat side down. Packs parts side by side on plates, or stacked in a
/// box.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// How to lay a mesh flat. At most one of `normal`, `point` and `most_stable` chooses the side of
/// the convex hull that goes down; otherwise the side of the largest area does.
struct lay_flat_options {
    /// The side whose outward normal makes the least angle with this direction, of any length, in
    /// the coordinates of the mesh.
    std::optional<point3> normal{};
    /// The side nearest to this point: the one that contains it, if one does.
    std::optional<point3> point{};
    bool most_stable = false;  ///< the side with the largest tip angle
    /// Do not rotate about the vertical. Otherwise the mesh is also rotated about it, by at most 45
    /// degrees, so that the longest edge of the side runs along x or y.
    bool keep_spin = false;
    /// Points at most this far from the plane of a side belong to it. With 0, a side is exactly
    /// coplanar, which suits models in round numbers. A flat face that was rotated and rounded
    /// falls into many exactly coplanar sides; about 1e-6 of the size joins them.
    double tolerance = 0.0;
    double bed = 0.0;                 ///< z of the bed
    double overhang_angle = 45.0;     ///< in degrees from the vertical, 0 to 90
    std::size_t overhang_sides = 32;  ///< compute the overhangs of this many sides
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// A mesh on the bed.
struct laid_flat {
    std::vector<point3> points{};  ///< [V] the new points, as they are to be written
    /// new = M * old, a rotation and a translation. `points` differ from it by a few units in the
    /// last place of the largest coordinate, old or new.
    transform<3> matrix{};
    /// Z of the points on the bed; with float32, the least number not below the bed.
    double bed = 0.0;
    /// The sides of the convex hull before the rotation, largest area first. With a tolerance, a
    /// side includes its neighbors within the tolerance of its plane.
    std::vector<hull_side> sides{};
    /// [S] for each side the least tilt, in degrees, that brings the center of mass over an edge of
    /// it, so that the mesh tips over. 90 if the center is in the plane of the side. Negative if
    /// the center is not over the side: then the mesh tips over by itself.
    std::vector<double> tip_angles{};
    std::vector<double> center_heights{};  ///< [S] height of the center of mass above each side
    /// [S] area of the faces that need support if the side is down: faces off the bed that point
    /// down at more than `overhang_angle` from the vertical. Only computed for the first
    /// `overhang_sides` sides and the chosen one, else NaN.
    std::vector<double> overhangs{};
    point3 center_of_mass{};  ///< before the rotation, rounded
    /// What the mass is attributed to: 3 for the solid that a closed mesh bounds; 2 for the faces
    /// of an open mesh, as sheets of equal thickness; 0 for the points of a mesh without a face of
    /// positive area.
    int mass_dimension = 3;
    std::size_t chosen = 0;                      ///< number in `sides`
    std::vector<std::uint32_t> on_bed{};         ///< points of the chosen side, ascending
    std::optional<placement_contact> contact{};  ///< a lowest point, and its face
    /// The largest change of a z, after the rotation, that put a point onto the bed: a few units in
    /// the last place; with a tolerance, about the tolerance.
    double corrected = 0.0;
    /// ok, or `cancelled`: then the rest is empty. `max_displacement` includes `corrected`.
    treeform::certificate certificate{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// For messages: "on side 0 of 6, of area 24". Empty if cancelled.
    [[nodiscard]] TREEFORM_API std::string message() const;
    /// The result as a `placement`, without fixed meshes.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// Rotates `mesh` so that a flat side of its convex hull is on the bed. The center of its box keeps
/// x and y. None if there is no side: fewer than three points, or all on a line.
///
/// Every point in the plane of the side, exactly or within the tolerance, gets exactly the z of the
/// bed, and no point is below. Areas and angles are rounded; values within 2^-40 of the best are
/// treated as equal. Of equal sides, one that is already exactly down is chosen, else the largest,
/// else the first in `sides`. Points without faces move along and are otherwise ignored; a mesh
/// without faces uses all its points.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range; for a zero `normal`; for several choices of a side; for options that are not
///         finite, a negative tolerance, or an overhang angle out of range
/// \throws std::overflow_error for coordinates that overflow in the rotation
/// \cost   `convex_hull`, plus O(F) for the center of mass and for each side with an overhang
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<laid_flat> lay_flat(const mesh_ref& mesh,
                                                             const lay_flat_options& options = {});

/// The plates, and options of packing.
struct pack_options {
    /// Length, depth and height of the plate or box. An infinite height, or 0, means no limit, so
    /// that {250, 210, 0} is a plate.
    point3 size{0.0, 0.0, std::numeric_limits<double>::infinity()};
    /// The corner of the first plate with the lowest x and y; its z is the bed.
    point3 corner{};
    double spacing = 2.0;  ///< least distance between parts; parts may touch the plate's rim
    /// Rotations about the vertical that are tried for each part, evenly over the full circle: 1
    /// (none), 2, 3, 4, 6, 8, 12 or 24.
    unsigned turns = 4;
    /// Fill the box up to its height, which must be finite: parts may be above, below and inside
    /// one another, and hang in the air. Otherwise each part stands on the bed.
    bool stack = false;
    unsigned plates = 1;  ///< largest number of plates to use; at least 1
    point3 plate_step{};  ///< from the corner of a plate to that of the next; its z is ignored
    bool tighten = true;  ///< close gaps left by the raster
    /// Seed of the orders and rotations that are tried if not all parts fit.
    std::uint64_t seed = 0;
    unsigned tries = 32;  ///< largest number of tries; at least 1
    /// Start no more tries after this many seconds. If that ends the search, the result depends on
    /// the speed of the machine.
    double seconds = std::numeric_limits<double>::infinity();
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// A part on a plate.
struct packed_part {
    bool placed = false;  ///< whether a position was found
    unsigned plate = 0;   ///< number of its plate, from 0
    /// [V] the new points, rounded to the precision; unchanged if the part is not placed.
    std::vector<point3> points{};
    /// new = M * old, a rotation about z and a translation; the identity if the part is not placed.
    /// `points` differ from it by a few units in the last place of the largest coordinate.
    transform<3> matrix{};
};

/// Filled plates.
struct packing {
    std::vector<packed_part> parts{};         ///< [P] in the order of the input
    std::vector<std::uint32_t> not_placed{};  ///< numbers of parts without a position, ascending
    unsigned plates_used = 0;                 ///< plates with a part
    unsigned tries = 0;                       ///< number of tries made
    /// Share of the area of the used plates that their parts cover, by the raster; with `stack`,
    /// share of the volume that the solids fill, cavities included.
    double density = 0.0;
    /// Number of pairs of parts whose faces were compared, since their boxes are nearer than the
    /// spacing.
    std::uint64_t pairs_measured = 0;
    double bed = 0.0;  ///< least z of a placed part that stands on the bed, rounded
    /// ok: the guarantees of `pack` hold for the points, even if some parts have no place.
    /// Otherwise `cancelled`, and the rest is empty.
    treeform::certificate certificate{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// For messages: "9 of 9 parts placed", "7 of 9 parts placed; not found in 32 tries".
    [[nodiscard]] TREEFORM_API std::string message() const;
};

/// Places the parts on plates, each rotated about z by one of `turns`. Unless stacked, each part
/// stands on the bed with its lowest point.
///
/// For the rounded coordinates in `points`:
/// - The lowest z of a placed part is exactly that of the bed (with float32, the least number not
///   below it); of a stacked part, it is not below the bed.
/// - No coordinate is outside the plate or above its height.
/// - Any two placed parts of a plate are at least `spacing` apart, by their exact boxes or by
///   `distance` minus its error, and no part is inside another. With a spacing of 0, parts may only
///   touch in a plane that separates their boxes.
///
/// A small part may stand in a hole of another, and `tighten` may move a part below an overhang. No
/// part is placed in a void that is closed all around.
///
/// This is a heuristic search: a place may exist for a part that is not placed. In the first try,
/// parts are placed in descending order of the area that they cover. Each part goes to the first
/// plate with room, to the free position with the least y, then the least x, on a raster of about
/// 512 cells a side. Then it is moved toward lower y and x until it meets an obstacle. With
/// `stack`, the order is by volume, z comes before y, and the raster has about 96 cells a side.
/// While parts are not placed, other orders and rotations are tried: at random by the seed, and
/// with unplaced parts first. With several plates, tries also go on while more plates are used than
/// the area requires. The result is the try with the most parts placed, then with the least area
/// unplaced, then with the fewest plates, then the earliest.
///
/// Empty parts occupy no space: they are placed at their present position. Points that no face uses
/// move along with their part and are otherwise ignored. Equal parts are prepared once.
///
/// \throws std::invalid_argument naming the part with a corner out of range or not finite; for
///         options that are negative, NaN, or (except for the height and the seconds) not finite
/// \cost   O(F) for a raster of each part and rotation; in each try a few milliseconds for each
///         part and rotation to find a free place; for the chosen place a tree over the part and
///         some `distance` to each neighbor. Tries run in parallel
/// \same   on any number of threads, unless `seconds` ends the search
[[nodiscard]] TREEFORM_API packing pack(const mesh_refs& parts, const pack_options& options);

}  // namespace treeform
