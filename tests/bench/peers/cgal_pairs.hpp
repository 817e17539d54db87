#pragma once
/// \file
/// Two meshes by the AABB tree of CGAL, triangle by triangle.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace treeform::bench {

/// The tree of one mesh (EPICK, triangle primitives), which is asked about each triangle of the
/// other at its place.
class cgal_pair {
  public:
    cgal_pair(const mesh& a, const mesh& b);
    ~cgal_pair();

    /// Whether they meet.
    [[nodiscard]] bool collide(const transform<3>& pose) const;
    /// How many pairs of triangles meet.
    [[nodiscard]] std::size_t intersect(const transform<3>& pose) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::bench
