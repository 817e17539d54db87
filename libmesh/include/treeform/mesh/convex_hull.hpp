#pragma once
/// \file
/// The exact convex hull of points, and its flat sides; a small box in any orientation around
/// points.

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

/// A flat side of a convex hull: all coplanar faces of one plane.
struct hull_side {
    /// The first of its faces, in `convex_hull_result::faces`; each of them spans the plane.
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    double area = 0.0;  ///< rounded; infinite on overflow
    point3 normal;      ///< outward, of length 1, rounded
    point3 center;      ///< centroid of its area, rounded
    friend bool operator==(const hull_side&, const hull_side&) = default;
};

/// The hull as triangles, grouped by side.
struct convex_hull_result {
    /// The dimension that the points span: 3, 2 in a plane, 1 on a line, 0 if all are equal, -1 for
    /// no points.
    int dimension = -1;
    /// [F] triangles of the hull as point numbers, oriented outward, in the order of `sides`. No
    /// two share more than an edge, and none is degenerate. Points in a plane have two sides of the
    /// same triangles, one facing each way. Points on a line, or equal ones, have none.
    std::vector<face> faces{};
    std::vector<hull_side> sides{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is empty

    /// The triangles of a side.
    [[nodiscard]] std::span<const face> faces_of(const hull_side& side) const {
        return std::span(faces).subspan(side.first_face, side.face_count);
    }

    /// The corners of a side in order around it, counter-clockwise seen from outside, starting at
    /// the lowest number. Corners on a straight part of the rim are omitted.
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
/// \throws std::invalid_argument naming the first point that is not finite; for more points than 32
///         bits can number
/// \cost   O(V log V) time for most inputs, O(V^2) for some; serial
/// \same   on every machine
/// \source Barber, Dobkin and Huhdanpaa, The Quickhull Algorithm for Convex Hulls, TOMS 22 (1996);
///         a point sees a face if it is strictly above it, which covers coplanar faces
[[nodiscard]] TREEFORM_API convex_hull_result convex_hull(points_view points,
                                                          const progress_callback& progress = {});

/// A box in any orientation.
struct oriented_box {
    point3 center{};  ///< center of the box
    /// Unit axes, right-handed, rounded: along the longest, middle and shortest side.
    std::array<point3, 3> axes{point3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    point3 size{};  ///< lengths along these axes
    friend bool operator==(const oriented_box&, const oriented_box&) = default;
};

/// A box of small volume around points. It is the smallest of these: the axis-aligned box, and all
/// boxes with a side in a side of the convex hull and another along an edge of that side. For
/// coplanar points, the one of least area. None without points. For a hull of more than a few
/// thousand sides, only the largest sides are tried, up to 2^26 corners of sides.
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
