#pragma once
/// \file
/// Which parts of an assembly penetrate each other, touch, or are too close; where, and how deep.
/// The same meshes in many poses.

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

/// How to look for clashes. `volumes` to `limit` are of `clash` alone.
struct clash_options {
    double clearance = 0.0;                ///< parts that are nearer than this are too close
    bool volumes = true;                   ///< of what two closed parts have in common
    bool depths = true;                    ///< of penetrating parts
    std::uint64_t effort = 0;              ///< for each depth, as in `depth_options`
    std::size_t limit = 1000;              ///< faces listed for each region and part
    bool first_only = false;               ///< `check_poses`: only the first clash of each pose
    std::span<const part_pair> ignored{};  ///< pairs that are not looked at, in any order
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// A place where two parts meet: pairs of faces that hang together, by corners of faces of either
/// part that meet the same face of the other.
struct contact_region {
    box3 box{};  ///< holds all points that the surfaces have in common here
    std::uint64_t face_pairs = 0;
    std::vector<std::uint32_t> faces_a{};  ///< ascending; the first `limit`
    std::vector<std::uint32_t> faces_b{};
};

/// Two parts that are not clear of each other.
struct part_clash {
    std::uint32_t a = 0;                             ///< the lower number
    std::uint32_t b = 0;                             ///< number of the second part
    mesh_relation how = mesh_relation::touching;     ///< or penetrating, closer_than_clearance
    bool a_inside_b = false;                         ///< as in `mesh_relation_result`
    bool b_inside_a = false;                         ///< the same with `a` and `b` swapped
    double distance = 0.0;                           ///< of the surfaces; 0 where they meet
    std::optional<std::array<point3, 2>> nearest{};  ///< of those that are too close: on a, on b
    std::uint64_t face_pairs = 0;                    ///< that meet
    std::vector<contact_region> regions{};           ///< by their lowest faces
    /// Of penetrating parts that are closed: the volume of what is inside both, by the exact
    /// arrangement, as `operand_volumes::both`.
    std::optional<double> volume{};
    /// Of penetrating parts: `penetration_depth`, the length of `move`, which takes `a` out of `b`.
    std::optional<double> depth{};
    point3 move{};                 ///< a short translation that takes `a` out of `b`
    search_effort depth_effort{};  ///< of `depth`, as in `penetration_depth_result`
};

/// All that is not clear.
struct clash_result {
    std::vector<part_clash> pairs{};        ///< that are not clear, ascending
    std::array<std::uint64_t, 5> counts{};  ///< of pairs that were looked at, by `mesh_relation`
    std::uint64_t boxes_apart = 0;          ///< pairs that their boxes keep apart: not looked at
    std::uint64_t ignored = 0;              ///< pairs left out whose boxes are not apart
    std::uint64_t parts_indexed = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing else is set

    /// Pairs that penetrate or are closer than the clearance; with a clearance, those that touch,
    /// too.
    std::uint64_t clashes = 0;
};

/// How all parts of an assembly lie to each other, two by two.
///
/// Exact, as `relation`: parts penetrate, touch, or are separate. Boxes decide nothing but which
/// pairs need not be looked at: rings in each other, or an L around a corner, whose boxes overlap,
/// are clear if they do not meet. Parts without faces are clear of all. A distance is that of
/// `distance`, and only looked for with a clearance. A part is indexed when its box comes near
/// another's.
///
/// \throws std::invalid_argument naming the part and its lowest face with a corner out of range or
///         not finite, for a clearance that is negative or not finite, an ignored pair with a
///         number out of range
/// \cost   O(N log N + P) for N parts, P pairs of them whose boxes are within the clearance; and
///         for each of these `relation`, `distance` with a clearance, `mesh_intersections` where
///         they meet, `intersection` and `penetration_depth` where they penetrate
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API clash_result clash(const mesh_refs& parts,
                                              const clash_options& options = {});

/// All pairs of different parts of which one's name matches the first pattern, and the other's the
/// second; ascending, each once, the lower number first.
[[nodiscard]] TREEFORM_API std::vector<part_pair> pairs_named(std::span<const std::string> names,
                                                              std::string_view first,
                                                              std::string_view second);

/// [P] `intersects` for many positions, in parallel.
///
/// \throws std::invalid_argument as `intersects`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<bool> intersects(const mesh_ref& a, const mesh_ref& b,
                                                        std::span<const mesh_positions> positions);

/// [P] `distance` for many positions, in parallel; infinite beyond the radius of each.
///
/// \throws std::invalid_argument as `distance`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<double> distance(const mesh_ref& a, const mesh_ref& b,
                                                        std::span<const mesh_positions> positions);

/// Two parts that are not clear of each other in a pose.
struct pose_clash {
    std::uint32_t a = 0;  ///< the lower number
    std::uint32_t b = 0;
    mesh_relation how = mesh_relation::touching;  ///< or penetrating, closer_than_clearance
    double distance = 0.0;  ///< of those that are closer than the clearance; else 0
    friend bool operator==(const pose_clash&, const pose_clash&) = default;
};

struct pose_result {
    /// [P] the parts that are not clear, ascending. With `first_only` at most one: the lowest pair
    /// that penetrates, is too close or, with a clearance, touches; those that only touch otherwise
    /// are left out.
    std::vector<std::vector<pose_clash>> poses{};
    std::uint64_t clashing = 0;     ///< poses with a pair that penetrates or is too close
    std::uint64_t boxes_apart = 0;  ///< pairs that their boxes keep apart, over all poses
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing else is set
};

/// What clashes in each of many poses. `poses` has a transform for each part, pose after pose:
/// `poses[p * parts.size() + i]` moves part i in pose p.
///
/// Exact, as `clash` and `relation`, for the corners that the transforms give, rounded to double
/// (`transform::operator()`). No part is copied or indexed anew, except where two moved parts
/// touch, or a corner of one is so near the surface of another that rounding might put it on the
/// other side, or a transform is no motion: then these two are looked at as they are moved.
///
/// \throws std::invalid_argument naming the part and its lowest face with a corner out of range or
///         not finite, the pose with a transform that is not finite, for a number of transforms
///         that is no multiple of that of parts, and as `clash`
/// \cost   the indexes of the parts; then, for each pose, O(N^2) comparisons of boxes, and an
///         `intersects` for pairs whose boxes overlap
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API pose_result check_poses(const mesh_refs& parts,
                                                   std::span<const transform<3>> poses,
                                                   const clash_options& options = {});

}  // namespace treeform
