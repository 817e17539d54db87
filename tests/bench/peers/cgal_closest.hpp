#pragma once
/// \file
/// The nearest point of a mesh by CGAL.

#include <treeform/mesh/mesh.hpp>

#include <memory>
#include <vector>

namespace treeform::bench {

/// AABB_tree (simple Cartesian doubles, triangle primitives) with its own tree for first guesses,
/// `accelerate_distance_queries`.
class cgal_closest {
  public:
    explicit cgal_closest(const mesh& mesh);
    ~cgal_closest();

    /// [Q] the distance of each query to the nearest point of the mesh.
    [[nodiscard]] std::vector<double> distances(const std::vector<point3>& queries) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::bench
