#pragma once
/// \file
/// Turns a flat side of a mesh down and puts it on a bed.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
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

}  // namespace treeform
