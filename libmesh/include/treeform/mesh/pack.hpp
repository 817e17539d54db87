#pragma once
/// \file
/// Turns a flat side of a mesh down and puts it on a bed. Puts parts side by side on plates, or on
/// top of each other in a box.

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

/// Which side of the convex hull goes down.
enum class lay_choice : std::uint8_t {
    largest,         ///< the side of the largest area
    nearest_normal,  ///< the side whose outward normal makes the least angle with `toward`
    holding_point,   ///< the side nearest to `toward`: the one that contains it, if one does
    most_stable      ///< the side with the largest tip angle
};

/// Of what the center of mass is.
enum class mass_of : std::uint8_t {
    solid,    ///< what a closed mesh bounds
    surface,  ///< the faces, where they do not bound a solid: as sheets of equal thickness
    points    ///< of a mesh without faces
};

/// How a mesh stands on a side.
struct side_stability {
    /// The least tilt, in degrees, that brings the center of mass over an edge of the side: then it
    /// tips over. 90 where the center is in the plane of the side. Negative where the center is not
    /// over the side: it tips over by itself.
    double tip_angle = 0.0;
    double height = 0.0;  ///< of the center of mass over the plane of the side
    /// Area of the faces that would need support: that look down more than `overhang_angle` from
    /// the vertical and are not on the bed. Only known of the first `overhang_sides` sides and the
    /// chosen one, else NaN.
    double overhang = 0.0;
};

/// How to lay a mesh flat.
struct lay_flat_options {
    lay_choice choose = lay_choice::largest;
    point3 toward{};  ///< a direction of any length, or a point, in the coordinates of the mesh
    /// Only bring the side down. Otherwise the mesh is also turned about the vertical, by at most
    /// 45 degrees, until the longest edge of the side runs along x or y.
    bool keep_spin = false;
    /// Points at most this far from the plane of a side belong to it. With 0, a side is exactly in
    /// one plane. That fits models in round numbers. A flat face that was turned and rounded before
    /// then falls into many sides; about 1e-6 of the size joins them again.
    double tolerance = 0.0;
    double bed = 0.0;              ///< z of the bed
    double overhang_angle = 45.0;  ///< in degrees from the vertical, 0 to 90
    std::size_t overhang_sides = 32;
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// A mesh on the bed.
struct laid_flat {
    std::vector<point3> points{};  ///< [V] the new points, as they are to be written
    /// new = M * old, a rotation and a translation. `points` differ from it by a few units in the
    /// last place of the largest coordinate, old or new.
    transform<3> matrix{};
    double bed = 0.0;  ///< z of the points on the bed; with float32, the least one not below it
    /// The sides of the convex hull before the turn, largest area first. With a tolerance, each is
    /// a side of the hull together with its neighbors within the tolerance of its plane.
    std::vector<hull_side> sides{};
    std::vector<side_stability> stability{};     ///< of each of `sides`
    point3 center_of_mass{};                     ///< before the turn, rounded
    mass_of mass = mass_of::solid;               ///< what that is the center of
    std::size_t chosen = 0;                      ///< number in `sides`
    std::vector<std::uint32_t> on_bed{};         ///< points of that side, ascending
    std::optional<placement_contact> contact{};  ///< the lowest face with the lowest point
    /// The most that a z was changed, beyond the rotation, to be on the bed or not below it: some
    /// units in the last place; with a tolerance, about as much as that.
    double corrected = 0.0;
    /// ok, or `cancelled`: then the rest is empty. `max_displacement` includes what was corrected.
    treeform::certificate certificate{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// For people: "on side 0 of 6, of area 24". Empty where it was cancelled.
    [[nodiscard]] TREEFORM_API std::string message() const;
    /// The same in the terms of all placements; nothing fixed was looked at.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// Turns `mesh` so that a flat side of its convex hull is on the bed. The center of its box keeps x
/// and y. None when there is no side: fewer than three points, or all on a line.
///
/// Every point in the plane of the side, exactly or within the tolerance, then has exactly the z of
/// the bed, and no point is below. Areas and angles are rounded; those within 2^-40 of the best are
/// treated as equal. Of equal sides, one that is exactly down already is chosen, else the largest,
/// else the first in `sides`. Points that no face uses move along and are otherwise ignored; a mesh
/// without faces uses all its points.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range; for a direction that is zero where one is needed; for options not
///         finite, a negative tolerance, and an overhang angle out of range
/// \throws std::overflow_error for coordinates too large to be turned
/// \cost   that of `convex_hull`, and O(F) for the center of mass and each side with an overhang
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<laid_flat> lay_flat(const mesh_ref& mesh,
                                                             const lay_flat_options& options = {});

/// How many turns about the vertical are tried for each part.
enum class plate_turns : std::uint8_t {
    none,
    quarter,  ///< 4, by 90 degrees
    eighth,   ///< 8, by 45 degrees
    any,      ///< 24, by 15 degrees
};

/// The plates, and how to fill them.
struct pack_options {
    /// Length, depth and height of the plate or box. The height may be infinite.
    point3 size{0.0, 0.0, std::numeric_limits<double>::infinity()};
    point3 corner{};       ///< corner of the first plate with the lowest x and y; its z is the bed
    double spacing = 2.0;  ///< least distance of any two parts; parts may touch the plate's rim
    plate_turns turns = plate_turns::quarter;
    /// Fill the box up to its height: parts also come above, below and inside one another, and hang
    /// in the air. Otherwise each stands on the bed. The height has to be finite.
    bool stack = false;
    unsigned plates = 1;     ///< most plates used; at least 1
    point3 plate_step{};     ///< from the corner of a plate to that of the next; its z is ignored
    bool tighten = true;     ///< close the gaps that the raster leaves
    std::uint64_t seed = 0;  ///< of the orders and turns that are tried when not all parts fit
    unsigned tries = 32;     ///< at most; at least 1
    /// No more tries begin after this many seconds. Where that ends the search, the result depends
    /// on the speed of the machine.
    double seconds = std::numeric_limits<double>::infinity();
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// A part on a plate.
struct packed_part {
    bool placed = false;  ///< it has a place
    unsigned plate = 0;   ///< number of its plate, from 0
    /// [V] the new points, as they are to be written; unchanged when the part is not placed.
    std::vector<point3> points{};
    /// new = M * old, a turn about z and a translation; the identity when the part is not placed.
    /// `points` differ from it by a few units in the last place of the largest coordinate.
    transform<3> matrix{};
};

/// Filled plates.
struct packing {
    std::vector<packed_part> parts{};         ///< [P] in the order of the input
    std::vector<std::uint32_t> not_placed{};  ///< numbers of parts without a place, ascending
    unsigned plates_used = 0;                 ///< plates with a part
    unsigned tries = 0;                       ///< made
    /// Share of the plates that the parts on them cover, seen from above, as the raster has it;
    /// with `stack`, of the boxes that their solids with what they enclose fill.
    double density = 0.0;
    /// Pairs of parts whose faces were compared, because their boxes are nearer than the spacing.
    std::uint64_t pairs_measured = 0;
    double bed = 0.0;  ///< least z of a placed part that stands on the bed, as written
    /// ok: what `pack` promises of the points holds, also where parts have no place. Otherwise
    /// `cancelled`, and the rest is empty.
    treeform::certificate certificate{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
    /// For people: "9 of 9 parts placed", "7 of 9 parts placed; not found in 32 tries".
    [[nodiscard]] TREEFORM_API std::string message() const;
};

/// Puts the parts on plates, each turned about z by one of `turns`. Unless they are stacked, each
/// stands on the bed with its lowest point.
///
/// For the coordinates in `points`, as written:
/// - The lowest z of a placed part is exactly that of the bed (with float32, the least one not
///   below it); of a stacked part, not below it.
/// - No coordinate is outside the plate or above its height.
/// - Any two placed parts of a plate are at least `spacing` apart, by their exact boxes or by
///   `distance` less its error, and none is inside another's solid. With a spacing of 0, parts may
///   touch only in a plane that separates their boxes.
///
/// A small part may stand in a hole of another, and `tighten` may move a part below an overhang.
/// A void that is closed all around stays empty.
///
/// This is a search, and a part that is not placed may have had a place. In the first try, parts
/// are taken in the order of the area that they cover (stacked, of their volume). Each goes to the
/// first plate that has room, there to the free place of the least (z, then) y, then x, on a raster
/// of about 512 cells a side (stacked, 96), and is then moved down (z,) y and x until something is
/// in the way. While not all are placed, other orders and turns are tried: at random by the seed,
/// and with parts that found no place brought forward. With several plates, tries also go on while
/// more plates are used than the area asks for. The result is the try with the most parts placed,
/// then with the least area left, then with the fewest plates, then the first.
///
/// Parts without faces take no room: they are placed where they are. Points that no face uses move
/// along with their part and are otherwise ignored. Equal parts are prepared once.
///
/// \throws std::invalid_argument naming the part with a corner out of range or not finite, and
///         for options that are negative, NaN, or (except for the height and the seconds) not
///         finite
/// \cost   for each part and turn a raster, O(F); in each try for each part and turn a few
///         milliseconds to search a free place, and for the place chosen a tree over the part and
///         some `distance` to each neighbor. Tries run in parallel
/// \same   on any number of threads, unless `seconds` ends the search
[[nodiscard]] TREEFORM_API packing pack(const mesh_refs& parts, const pack_options& options);

}  // namespace treeform
