#pragma once
/// \file
/// The exact convex hull of points, and its flat sides.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
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

/// The corners of a side in order around it, counter-clockwise seen from outside, starting at the
/// lowest number. Corners at which the rim goes straight on are left out.
///
/// \pre `side` is one of `hull.sides`, and `hull` is that of `points`
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> corners_of(const convex_hull_result& hull,
                                                                 const hull_side& side,
                                                                 points_view points);

}  // namespace treeform
