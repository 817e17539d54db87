#pragma once
/// \file
/// Moves a mesh relative to others: slide, drop, mate (by nearest points, planes or axes),
/// separate.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace treeform {

/// Options of the placement functions. Each function ignores those that do not concern it.
struct placement_options {
    double clearance = 0.0;              ///< gap to leave, a distance; 0: contact
    std::optional<double> max_travel{};  ///< largest distance to move; obstacles beyond are ignored
    /// `mate_features`: let planes face the same way instead of each other; reverse the axis of
    /// `moving`.
    bool flip = false;
    double max_angle = 360.0;  ///< `turn`: in degrees; greater than 0, up to 360
    /// `turn`: the gap, beyond the clearance, that counts as contact; greater than 0. Default:
    /// 2^-32 of the largest distance of a point from the axis.
    std::optional<double> tolerance{};
    std::size_t max_steps = 20'000;                                ///< `turn`
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    /// `slide` and `drop`: z of a bed, which also stops the mesh. Points that rest on it have
    /// exactly its z (with float32, the least float not below it), and no point is below. By
    /// default none, but 0 for `drop` without fixed meshes.
    std::optional<double> bed{};
    /// `slide`: close a gap that rounding leaves at a contact, by units in the last place.
    bool close_in = true;
    std::size_t normals = 24;  ///< `separate`: try at most this many normals of faces
    /// `separate`: take the normals from at most this many pairs of faces for each fixed mesh
    std::size_t face_pairs = 64;
    /// `separate`: largest number of pairs of faces to test; a pair in motion counts as two. 0: 20
    /// million plus 200 for each face. Distances for a clearance do not count.
    std::uint64_t effort = 0;
    /// largest number of contacts listed; for `separate`, for each fixed mesh
    std::size_t limit = 1000;
    vertex_identity vertices =
        vertex_identity::by_coordinates;  ///< which corners are the same vertex
    progress_callback progress{};
};

/// Moves `moving` along `direction` (of any length) until it first meets one of `fixed`, or is at
/// the clearance from one.
///
/// Without a clearance, the time of contact is exact (`time_of_impact`); with a clearance, it is
/// that of `time_to_distance`. The returned coordinates are checked again: if rounding made the
/// mesh penetrate, or come nearer than the clearance, it is moved back by units in the last place.
/// A mesh that touches at the start stays there. A mesh that penetrates at the start has no place.
/// Points that no face uses move along and are otherwise ignored; points without any face are a
/// cloud.
///
/// Only fixed meshes on the way are tested and indexed. For many calls, pass prepared meshes.
///
/// \throws std::invalid_argument for a direction that is zero or not finite; a clearance that is
///         negative or not finite; a bed that is not finite or beyond float32, or with a direction
///         that does not lead down to it; naming the operand and its lowest face with a corner out
///         of range or not finite
/// \cost   O(V + F) of all meshes to check the input; the search in motion; for each attempt at
///         rounding a tree over `moving` and a `relation` to the meshes nearby
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement slide(const mesh_ref& moving, const mesh_refs& fixed,
                                           const point3& direction,
                                           const placement_options& options = {});

/// Moves `moving` down until it rests on the bed. If it starts below the bed, it moves up, against
/// the direction.
///
/// \throws std::invalid_argument as `slide`; for a direction that does not point down
/// \cost   O(V)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement drop(const mesh_ref& moving,
                                          const placement_options& options = {},
                                          const point3& direction = {0.0, 0.0, -1.0});

/// Moves `moving` down until it rests on one of `fixed`, or on the bed if there is one, as `slide`
/// does. A mesh that starts below the bed has no place.
[[nodiscard]] TREEFORM_API placement drop(const mesh_ref& moving, const mesh_refs& fixed,
                                          const placement_options& options = {},
                                          const point3& direction = {0.0, 0.0, -1.0});

/// Translates `moving` so that the nearest points of `moving` and `fixed` meet, or are at the
/// clearance. Coordinates are checked as in `slide`. A mesh that touches stays; a mesh that
/// penetrates has no place.
///
/// \throws std::invalid_argument as `slide`
/// \cost   `measure` for the fixed meshes that may be the nearest, and a `slide`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement mate(const mesh_ref& moving, const mesh_refs& fixed,
                                          const placement_options& options = {});

/// Translates `moving` to a place where it penetrates none of `fixed` and keeps the clearance. If
/// it already does, in coordinates of the precision, it stays.
///
/// About fifty directions are tried: along the axes, away from the nearest points, along normals of
/// faces that meet, and others around the best. The nearest of the places found is returned, if its
/// coordinates pass the check of `slide`. It need not be the globally nearest place, which is on
/// the boundary of a set with O(n^2 m^2) faces, for meshes of n and m faces. The search is limited
/// by `effort`, and skips candidates that would take much of it, as in `penetration_depth`;
/// `placement::effort` counts them.
///
/// \throws std::invalid_argument as `slide`
/// \cost   for each direction up to about 12 `intersects` or `distance`, a tree over `moving` and a
///         search in motion
/// \same   on any number of threads
/// \source on the cost of the least translation: Dobkin, Hershberger, Kirkpatrick and Suri,
///         Computing the Intersection-Depth of Polyhedra, Algorithmica 9 (1993)
[[nodiscard]] TREEFORM_API placement separate(const mesh_ref& moving, const mesh_refs& fixed,
                                              const placement_options& options = {});

/// The relation of `moving` to all of `fixed` at its present position. Moves nothing. Meshes nearer
/// than the clearance are `closer_than_clearance`.
///
/// \throws std::invalid_argument as `slide`
/// \cost   `measure` for the fixed meshes that may be the nearest, and the pairs of faces that meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement measure_in_place(const mesh_ref& moving,
                                                      const mesh_refs& fixed,
                                                      const placement_options& options = {});

/// Rotates `moving` by the least angle that makes the features' directions opposite (planes) or
/// parallel (axes), aligns their centers, and slides `moving` from outside along the direction of
/// the fixed feature until first contact with any of `fixed`, or the clearance, exactly like
/// `slide`. Planes approach from the front of the fixed plane; axes from the side where `moving`
/// is.
///
/// A shaft may go through its bore and meet nothing: then its center stays at the center of the
/// bore, if that penetrates nothing and keeps the clearance. The place is checked exactly, on the
/// returned coordinates. `travel` is always 0.
///
/// \throws std::invalid_argument as `slide`; for features of different kinds, with a direction that
///         is not of length 1, or with an origin that is not finite
/// \cost   that of `slide`, and two trees over `moving`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API placement mate_features(const mesh_ref& moving, const mesh_refs& fixed,
                                                   const mesh_feature& of_moving,
                                                   const mesh_feature& of_fixed,
                                                   const placement_options& options = {});

}  // namespace treeform
