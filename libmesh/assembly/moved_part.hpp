#pragma once
/// \file
/// The pairs of parts of an assembly that may meet; relations of moved parts.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::assembly {

/// [parts] The box of the points that faces use; empty without faces.
[[nodiscard]] std::vector<std::optional<box3>> boxes_of(std::span<const prepared_mesh> parts);

/// Pairs of parts whose boxes are within `distance` of each other along each axis; ascending, each
/// with the lower number first.
[[nodiscard]] std::vector<part_pair> near_pairs(const std::vector<std::optional<box3>>& boxes,
                                                double distance);

/// The pairs in ascending order, without duplicates, each with the lower number first.
/// \throws std::invalid_argument, naming `function` (for example "clash"), for a number not less
///         than `count`
[[nodiscard]] std::vector<part_pair> sorted_pairs(const char* function,
                                                  std::span<const part_pair> pairs,
                                                  std::size_t count);

/// Data of a part that does not depend on its motion.
class resting_part {
  public:
    resting_part(const prepared_mesh& mesh, vertex_identity vertices);

    [[nodiscard]] const place::shape& shape() const { return shape_; }
    [[nodiscard]] const std::optional<box3>& box() const { return box_; }
    [[nodiscard]] bool solid() const { return solid_; }
    /// One corner of each component, which represents its component when no faces meet: then the
    /// whole component is on the side of that corner.
    [[nodiscard]] const std::vector<point3>& corners() const { return corners_; }

  private:
    place::shape shape_;
    std::optional<box3> box_;
    bool solid_;
    std::vector<point3> corners_;
};

struct part_relation {
    mesh_relation relation = mesh_relation::disjoint;
    double distance = 0.0;
};

/// \pre the part outlives this; the transform is finite
class moved_part {
  public:
    moved_part(const resting_part& part, const transform<3>& move);

    /// Whether the boxes are within `distance` of each other along each axis.
    [[nodiscard]] bool near(const moved_part& other, double distance) const;

    /// The exact relation for the moved corners; computes a distance only with a clearance.
    [[nodiscard]] part_relation relation_to(const moved_part& other, double clearance) const;

  private:
    [[nodiscard]] std::optional<bool> holds(const point3& p) const;
    [[nodiscard]] std::optional<bool> holds_part_of(const moved_part& other) const;
    [[nodiscard]] part_relation as_moved(const moved_part& other) const;
    [[nodiscard]] std::vector<point3> points() const;

    const resting_part* part_;
    transform<3> move_;
    std::optional<box3> box_{};  ///< box of the moved corners
};

}  // namespace treeform::detail::assembly
