#pragma once
/// \file
/// The bounding volume hierarchies of FCL, in double.

#include "bench/workload.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace treeform::bench {

enum class fcl_volume { aabb, obbrss, rss };

/// Builds a BVHModel over the triangles of a mesh that is given.
[[nodiscard]] job fcl_build(const mesh& mesh, fcl_volume volume);

/// Two models that stay where they are except for the pose of the second.
class fcl_pair {
  public:
    virtual ~fcl_pair() = default;
    /// Whether they meet.
    [[nodiscard]] virtual bool collide(const transform<3>& pose) const = 0;
    /// How many pairs of triangles meet.
    [[nodiscard]] virtual std::size_t intersect(const transform<3>& pose) const = 0;
    /// The least distance.
    [[nodiscard]] virtual double distance(const transform<3>& pose) const = 0;
};
[[nodiscard]] std::shared_ptr<const fcl_pair> fcl_pair_of(const mesh& a, const mesh& b,
                                                          fcl_volume volume);

}  // namespace treeform::bench
