#pragma once
/// \file
/// The kd-tree of nanoflann, over points in double.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace treeform::bench {

/// A tree over points that outlive it, with the leaf size its manual recommends.
class nanoflann_tree {
  public:
    explicit nanoflann_tree(const std::vector<point3>& points);
    ~nanoflann_tree();

    /// How many pairs of points are nearer than `reach`, each counted once.
    [[nodiscard]] std::size_t pairs_within(double reach) const;
    /// [Q * k] the numbers of the k nearest points of each query, nearest first, or fewer points
    /// than that in all.
    [[nodiscard]] std::vector<std::uint32_t> k_nearest(const std::vector<point3>& queries,
                                                       std::size_t k) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// The same over points rounded to float, asked in float.
class nanoflann_float_tree {
  public:
    explicit nanoflann_float_tree(const std::vector<point3>& points);
    ~nanoflann_float_tree();

    [[nodiscard]] std::vector<std::uint32_t> k_nearest(const std::vector<point3>& queries,
                                                       std::size_t k) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::bench
