#pragma once
/// \file
/// Where a ray meets a closed triangle, exactly.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/ray_predicates.hpp>
#include <treeform/mesh/triangle_triangle.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/ray.hpp>

#include <optional>

namespace treeform {

/// The points origin + t direction, t_min <= t <= t_max, with nothing rounded: t is a real number.
using ray3 = ray<double, 3>;

/// The first point of a ray in a triangle.
struct ray_contact {
    /// Part of the triangle that the first common point lies on: `interior`, an edge or a corner.
    feature at = feature::interior;
    /// The ray runs in the plane of the triangle, or the triangle has no area; otherwise there is
    /// just one common point.
    bool coplanar = false;
    /// Parameter of that point, with a relative error below 2^-40; within [t_min, t_max].
    double t = 0.0;
    /// Of the last common point, likewise; equal to t where there is one only.
    double t_end = 0.0;
    /// Where coplanar: t is t_min, and the line of the ray is in the triangle just before and just
    /// after it. `entry` says nothing then.
    bool from_start = false;
    /// A plane that meets the ray in that point alone: t as an exact number, for `compare`.
    cutting_plane entry{};
};

/// The first point of the ray in the closed triangle; none when they miss each other.
///
/// Exact on the coordinates as given, and watertight: whether a line passes to the left or to the
/// right of an edge is decided by the edge alone, so a ray that meets two triangles' common edge or
/// corner meets both, named for what it is, and one that enters a closed surface does not slip
/// through. A triangle without area is the segment or point that its corners span, named as by the
/// `intersect` of triangles. Neither the order of the corners nor the length of the direction
/// matters (features are renamed, t scaled accordingly).
///
/// \pre    every coordinate is finite, the direction is not zero, no parameter is NaN
/// \cost   O(1), no allocation; 3 `direction_side` for a miss, at most, and a `cut_parameter` for a
///         hit in the usual case
/// \source the three signs: Segura and Feito, Algorithms to Test Ray-Triangle Intersection, WSCG
///         2001
[[nodiscard]] TREEFORM_API std::optional<ray_contact> intersect(
    const ray3& ray, const triangle3& triangle, predicate_counters* counters = nullptr);

/// Sign of the difference of the exact parameters of two contacts of one ray: -1 when the ray gets
/// to `a` first, 0 when they are one point.
/// \pre both are what `intersect` gave for `ray`
[[nodiscard]] TREEFORM_API int compare(const ray3& ray, const ray_contact& a, const ray_contact& b,
                                       predicate_counters* counters = nullptr);

}  // namespace treeform
