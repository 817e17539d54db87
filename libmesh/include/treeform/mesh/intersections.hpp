#pragma once
/// \file
/// Intersections of two meshes, and of a mesh with a box.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform {

/// Which pairs of faces to look for, and where the meshes are.
struct mesh_intersection_options {
    /// Applied to each mesh first. A moved corner is what `transform::operator()` gives, rounded to
    /// double; the answer is exact for these coordinates. A prepared mesh itself is not changed.
    transform<3> move_a{};
    transform<3> move_b{};
    /// Stop at the first pair found: the same pair on any number of threads.
    bool first_only = false;
    /// Kinds to look for; the others are neither counted nor listed.
    pair_kinds kinds = pair_kinds::all;
    /// List at most this many pairs, those of the lowest face numbers. All are counted.
    std::size_t limit = static_cast<std::size_t>(-1);
    progress_callback progress{};
};

struct mesh_intersection_result {
    std::vector<face_pair> pairs;  ///< face `a` of the first mesh, `b` of the second; ascending
    std::array<std::uint64_t, pair_kind_count> counts{};  ///< by kind
    /// Pairs of faces whose boxes overlap, as moved; of prepared meshes, under a move both ways.
    std::uint64_t box_pairs = 0;
    std::uint64_t exact_pairs = 0;    ///< of these, undecided by the filter
    predicate_counters predicates{};  ///< what the undecided pairs cost
    search_statistics searched{};     ///< what was looked at; the rest of both meshes was skipped
    treeform::status status = treeform::status::ok;  ///< or `cancelled`
};

/// All pairs of a face of `a` and a face of `b` that have a common point.
///
/// Exact on the coordinates as given, or as moved. The kinds are crossing, overlap, touching and
/// degenerate: two meshes share no corners, so faces that meet in equal corners are `touching`, and
/// equal faces `overlap`. Surfaces count, not solids: a mesh inside the other that does not touch
/// it gives no pair. `a` and `b` may be the same mesh. Of meshes that are not prepared, only faces
/// that reach, as moved, into the intersection of both bounding boxes are indexed.
///
/// \throws std::invalid_argument when a transform is not finite, or naming the mesh and its face
///         with a corner out of range or, as moved, not finite
/// \cost   O(F log F) for indexes that are not built yet; O(B) time for the B pairs whose boxes
///         overlap and the nodes above them. Of prepared meshes up to twice as fast
/// \same   on any number of threads
/// \source candidate pairs: Sajovic, Knez and Korez, tf::tree, section III-C
[[nodiscard]] TREEFORM_API mesh_intersection_result mesh_intersections(
    const mesh_ref& a, const mesh_ref& b, const mesh_intersection_options& options = {});

/// Where each mesh is; see `mesh_intersection_options`.
struct mesh_positions {
    transform<3> move_a{};
    transform<3> move_b{};
};

/// Whether a face of `a` and a face of `b` have a common point; touching counts. Exact. Returns as
/// soon as one pair is found. Of meshes that are not prepared, only faces that reach, as moved, into
/// the intersection of both bounding boxes are indexed.
///
/// \throws std::invalid_argument as `mesh_intersections`
/// \same   in its answer, on any number of threads
[[nodiscard]] TREEFORM_API bool intersects(const mesh_ref& a, const mesh_ref& b,
                                           const mesh_positions& positions = {});

/// The faces, ascending, that have a point in the closed box from `min` to `max`.
///
/// Exact: faces are tested, not their boxes. A face that only touches the box is included. The box
/// may be flat, a line or a point.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument when a coordinate of the box is not finite or min exceeds max, or
///         naming the lowest face with a corner out of range
/// \cost   O(F) time
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> faces_in_box(const mesh_ref& mesh,
                                                                   const point3& min,
                                                                   const point3& max);

}  // namespace treeform
