#pragma once
/// \file
/// Clash detection: the parts of an assembly that penetrate, touch, or are too close, with regions
/// and depths. Also for many poses.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

/// Numbers of two parts.
using part_pair = std::array<std::uint32_t, 2>;

/// Options of `clash` and `check_poses`. Only `clash` uses `volumes`, `depths`, `effort` and
/// `limit`; only `check_poses` uses `first_only`.
struct clash_options {
    double clearance = 0.0;  ///< parts nearer than this are too close; not squared
    /// Compute the volume of the intersection of closed parts.
    bool volumes = true;
    bool depths = true;        ///< compute depths of penetrating parts
    std::uint64_t effort = 0;  ///< limit for each depth, as in `measure_options`
    std::size_t limit = 1000;  ///< largest number of faces listed for each region and part
    bool first_only = false;   ///< find only the first clash of each pose
    std::span<const part_pair> ignored{};  ///< pairs of parts to skip; any order
    vertex_identity vertices =
        vertex_identity::by_coordinates;  ///< which corners are the same vertex
    progress_callback progress{};
};

/// A connected contact of two parts: a set of pairs of faces that meet. Two pairs are linked if
/// they have the face of one part in common, and their faces of the other part share a corner.
struct contact_region {
    box3 box{};  ///< contains all common points of the surfaces in this region
    std::uint64_t face_pairs = 0;
    std::vector<std::uint32_t> faces_a{};  ///< ascending; the first `limit`
    std::vector<std::uint32_t> faces_b{};
};

/// Two parts that penetrate, touch, or are closer than the clearance.
struct part_clash {
    std::uint32_t a = 0;  ///< the lower number
    std::uint32_t b = 0;  ///< number of the second part
    /// `mesh_relation::touching`, `penetrating` or `closer_than_clearance`
    mesh_relation relation = mesh_relation::touching;
    bool a_inside_b = false;  ///< as in `measure`
    bool b_inside_a = false;  ///< the same with `a` and `b` swapped
    double distance = 0.0;    ///< distance of the surfaces; 0 if they meet
    /// For parts that are too close: the nearest points on a and on b.
    std::optional<std::array<point3, 2>> nearest{};
    std::uint64_t face_pairs = 0;           ///< pairs of faces that meet
    std::vector<contact_region> regions{};  ///< ordered by their lowest faces
    /// For closed parts that penetrate: the volume of their intersection.
    std::optional<double> volume{};
    /// For penetrating parts: `penetration_depth`, the length of `move`.
    std::optional<double> depth{};
    point3 move{};                 ///< a short translation that separates `a` from `b`
    search_effort depth_effort{};  ///< of `depth`, as in `penetration_depth_result`
};

/// The result of `clash`.
struct clash_result {
    std::vector<part_clash> pairs{};                 ///< pairs found, ascending
    counts_by<mesh_relation, 5> counts{};            ///< number of tested pairs, by `mesh_relation`
    std::uint64_t boxes_apart = 0;                   ///< pairs excluded by their boxes
    std::uint64_t ignored = 0;                       ///< ignored pairs that boxes do not exclude
    std::uint64_t parts_indexed = 0;                 ///< number of parts with an index
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid

    /// Number of pairs that penetrate or are closer than the clearance; with a clearance, also
    /// pairs that touch.
    std::uint64_t clashes = 0;
};

/// The relations of all pairs of parts of an assembly.
///
/// Exact, like `relation`: parts penetrate, touch, or are disjoint. Boxes only exclude pairs:
/// linked rings that do not meet are disjoint, although their boxes overlap. Empty parts are
/// disjoint from all. Distances are those of `distance`, and only computed with a clearance. A part
/// is only indexed if its box is near that of another.
///
/// \throws std::invalid_argument naming the part and its lowest face with a corner out of range or
///         not finite; for a clearance that is negative or not finite; for an ignored pair with a
///         number out of range
/// \cost   O(N log N + P) for N parts and the P pairs of parts whose boxes are within the
///         clearance; for each of these pairs `relation`, `distance` with a clearance,
///         `mesh_intersections` if they meet, `intersection` and `penetration_depth` if they
///         penetrate
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API clash_result clash(const mesh_refs& parts,
                                              const clash_options& options = {});

/// All pairs of different parts in which the name of one matches the pattern `first`, and the name
/// of the other matches `second`; ascending, without duplicates, each with the lower number first.
[[nodiscard]] TREEFORM_API std::vector<part_pair> pairs_named(std::span<const std::string> names,
                                                              std::string_view first,
                                                              std::string_view second);

/// [P] `intersects` for many positions, in parallel.
///
/// \throws std::invalid_argument as `intersects`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<bool> intersects(
    const mesh_ref& a, const mesh_ref& b, std::span<const mesh_pair_options> positions);

/// [P] `distance` for many positions, in parallel; infinite beyond the radius of each.
///
/// \throws std::invalid_argument as `distance`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<double> distance(
    const mesh_ref& a, const mesh_ref& b, std::span<const mesh_pair_options> positions);

/// Two parts that penetrate, touch, or are closer than the clearance in a pose.
struct pose_clash {
    std::uint32_t a = 0;  ///< the lower number
    std::uint32_t b = 0;
    /// `mesh_relation::touching`, `penetrating` or `closer_than_clearance`
    mesh_relation relation = mesh_relation::touching;
    double distance = 0.0;  ///< for parts closer than the clearance; else 0
    friend bool operator==(const pose_clash&, const pose_clash&) = default;
};

/// The clashes in each pose.
struct pose_result {
    /// [P] the pairs of each pose, ascending. With `first_only` at most one:
    /// the lowest pair that penetrates, is too close or, with a clearance, touches; without a
    /// clearance, pairs that touch are omitted.
    std::vector<std::vector<pose_clash>> poses{};
    /// [P] 1 for a pose with a pair that penetrates or is too close; with a clearance, also for one
    /// with a pair that touches. Else 0.
    std::vector<std::uint8_t> in_collision{};
    std::uint64_t clashing = 0;     ///< number of poses in collision
    std::uint64_t boxes_apart = 0;  ///< pairs excluded by their boxes, over all poses
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// The clashes in each of many poses. `poses` has a transform for each part, pose after pose:
/// `poses[p * parts.size() + i]` moves part i in pose p; the default transform leaves it in place.
/// All pairs are tested, also of parts that do not move: if such a pair meets, every pose is in
/// collision, unless `ignored` has it.
///
/// Exact, like `clash` and `relation`, for the moved corners, rounded to double
/// (`transform::operator()`). Two parts are only copied and indexed again for a pose if they touch,
/// if a corner of one is so near the surface of the other that rounding might change its side, or
/// if a transform is not a rigid motion.
///
/// \throws std::invalid_argument naming the part and its lowest face with a corner out of range or
///         not finite, the pose with a transform that is not finite; for a number of transforms
///         that is not a multiple of the number of parts; as `clash`
/// \cost   the indexes of the parts; for each pose O(N^2) comparisons of boxes, and an `intersects`
///         for each pair whose boxes overlap
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API pose_result check_poses(const mesh_refs& parts,
                                                   std::span<const transform<3>> poses,
                                                   const clash_options& options = {});

}  // namespace treeform
