#pragma once
/// \file
/// The same meshes in many poses: whether they meet, how far apart they are, what clashes.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform {

/// [P] `intersects` for many positions, in parallel.
///
/// \throws std::invalid_argument as `intersects`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<bool> intersects(const prepared_mesh& a,
                                                        const prepared_mesh& b,
                                                        std::span<const mesh_positions> positions);
[[nodiscard]] TREEFORM_API std::vector<bool> intersects(mesh_view a, mesh_view b,
                                                        std::span<const mesh_positions> positions);

/// [P] `distance` for many positions, in parallel; infinite beyond `radius`.
///
/// \throws std::invalid_argument as `distance`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<double> distance(
    const prepared_mesh& a, const prepared_mesh& b, std::span<const mesh_positions> positions,
    double radius = std::numeric_limits<double>::infinity());
[[nodiscard]] TREEFORM_API std::vector<double> distance(
    mesh_view a, mesh_view b, std::span<const mesh_positions> positions,
    double radius = std::numeric_limits<double>::infinity());

struct pose_options {
    double clearance = 0.0;                ///< parts that are nearer than this are too close
    bool first_only = false;               ///< name only the first clash of each pose
    std::span<const part_pair> ignored{};  ///< pairs that are not looked at, in any order
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// Two parts that are not clear of each other in a pose.
struct pose_clash {
    std::uint32_t a = 0;  ///< the lower number
    std::uint32_t b = 0;
    standing how = standing::touching;  ///< or penetrating, closer_than_clearance
    double distance = 0.0;              ///< of those that are closer than the clearance; else 0
    friend bool operator==(const pose_clash&, const pose_clash&) = default;
};

struct pose_result {
    /// [P] the parts that are not clear, ascending. With `first_only` at most one: the lowest pair
    /// that penetrates, is too close or, with a clearance, touches; those that only touch otherwise
    /// are left out.
    std::vector<std::vector<pose_clash>> poses{};
    std::uint64_t clashing = 0;     ///< poses with a pair that penetrates or is too close
    std::uint64_t boxes_apart = 0;  ///< pairs that their boxes keep apart, over all poses
    bool cancelled = false;         ///< `progress` asked to stop: nothing else is set
};

/// What clashes in each of many poses. `poses` has a transform for each part, pose after pose:
/// `poses[p * parts.size() + i]` moves part i in pose p.
///
/// Exact, as `clash` and `relation`, for the corners that the transforms give, rounded to double
/// (`transform::operator()`). No part is copied or indexed anew, except where two moved parts touch,
/// or a corner of one is so near the surface of another that rounding might put it on the other
/// side, or a transform is no motion: then these two are looked at as they are moved.
///
/// \throws std::invalid_argument naming the part and its lowest face with a corner out of range or
///         not finite, the pose with a transform that is not finite, for a number of transforms
///         that is no multiple of that of parts, and as `clash`
/// \cost   the indexes of the parts; then, for each pose, O(N^2) comparisons of boxes, and an
///         `intersects` for pairs whose boxes overlap
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API pose_result check_poses(std::span<const prepared_mesh> parts,
                                                   std::span<const transform<3>> poses,
                                                   const pose_options& options = {});

}  // namespace treeform
