#pragma once
/// \file
/// The exact convex hull of points, and its flat sides; the smallest box around points.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// A flat side of a convex hull: all of the hull that lies in one plane.
struct hull_side {
    /// The first of its faces, in `convex_hull_result::faces`; any three corners span its plane.
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    double area = 0.0;  ///< rounded; infinite where no double holds it
    point3 normal;      ///< outward, of length 1, rounded
    point3 center;      ///< of area, rounded
    friend bool operator==(const hull_side&, const hull_side&) = default;
};

/// The hull as triangles, grouped by side.
struct convex_hull_result {
    /// 3 for points that span space, 2 in a plane, 1 on a line, 0 when all are equal, -1 for none.
    int dimension = -1;
    /// [F] triangles of the hull, outward, by point numbers; those of one side after those of the
    /// side before it in `sides`. No two share more than an edge, and none is degenerate. Points in
    /// a plane have two sides of the same triangles, one facing each way. Points on a line, or
    /// equal ones, have none.
    std::vector<face> faces{};
    std::vector<hull_side> sides{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is empty

    /// The triangles of a side.
    [[nodiscard]] std::span<const face> faces_of(const hull_side& side) const {
        return std::span(faces).subspan(side.first_face, side.face_count);
    }

    /// The corners of a side in order around it, counter-clockwise seen from outside, starting at
    /// the lowest number. Corners at which the rim goes straight on are left out.
    ///
    /// \pre `side` is one of `sides`, and this is the hull of `points`
    [[nodiscard]] TREEFORM_API std::vector<std::uint32_t> corners_of(const hull_side& side,
                                                                     points_view points) const;

    /// The hull as a closed mesh, with the points that it uses, in their order.
    ///
    /// \pre this is the hull of `points`
    [[nodiscard]] TREEFORM_API treeform::mesh mesh(points_view points) const;
};

/// The convex hull of `points`, exact on the coordinates as given: no point is outside the plane of
/// a face, and faces belong to one side if and only if they are exactly coplanar. Of equal points,
/// the lowest number is used. Corners of triangles may lie on an edge or inside a side of the hull.
///
/// \throws std::invalid_argument naming the first point that is not finite, and for more points
///         than 32 bits can number
/// \cost   O(V log V) time for most inputs, O(V^2) for some; serial
/// \same   on every machine
/// \source Barber, Dobkin and Huhdanpaa, The Quickhull Algorithm for Convex Hulls, TOMS 22 (1996);
///         a point sees a face when it is strictly above it, so that coplanar faces need no care
[[nodiscard]] TREEFORM_API convex_hull_result convex_hull(points_view points,
                                                          const progress_callback& progress = {});

/// A box turned in any way.
struct oriented_box {
    point3 center{};  ///< of the box
    /// Of length 1, right-handed, rounded: along the longest side, the next, the shortest.
    std::array<point3, 3> axes{point3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    point3 size{};  ///< along these
    friend bool operator==(const oriented_box&, const oriented_box&) = default;
};

/// The box of least volume around points, of those with a side in a side of their convex hull, and
/// another along an edge of it, or along the axes of space. Of flat points, the least area.
/// None without points. Of a hull of more than some thousand sides, those of the largest areas are
/// looked at, as many as 2^26 corners of sides allow.
///
/// Axes, center and size are rounded: a point may be outside by 2^-48 of the largest coordinate.
///
/// \throws std::invalid_argument as `convex_hull`
/// \cost   `convex_hull`, and O(S H log H) for S sides and H corners of the hull
/// \same   on any number of threads
/// \source rectangles around polygons: Freeman and Shapira, Determining the Minimum-Area Encasing
///         Rectangle for an Arbitrary Closed Curve, CACM 18 (1975)
[[nodiscard]] TREEFORM_API std::optional<oriented_box> find_oriented_box(points_view points);

}  // namespace treeform
