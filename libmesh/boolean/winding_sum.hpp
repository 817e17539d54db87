#pragma once
/// \file
/// Generalized winding numbers, also for open surfaces.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::boolean {

/// Sums of the solid angles of faces, over a tree: distant nodes count as dipoles.
///
/// For heuristics only: not exact, but reproducible on all machines with IEEE doubles.
///
/// \cost   O(F log^2 F) to build, serial; O(log F) for each sum in practice
/// \source Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside Segmentation using
///         Generalized Winding Numbers, SIGGRAPH 2013; Barill, Dickson, Schmidt, Levin and
///         Jacobson, Fast Winding Numbers for Soups and Clouds, SIGGRAPH 2018, for dipoles
class winding_sum {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// \param times [F] how often each face counts, negative if flipped
    /// \pre   coordinates are below 2^20; `mesh` and `times` outlive this
    winding_sum(mesh_view mesh, const std::vector<double>& times);

    /// The generalized winding number around q, without the face `left_out`.
    [[nodiscard]] double around(const point3& q, std::uint32_t left_out = none) const;

  private:
    struct node {
        std::size_t begin = 0, end = 0;  ///< range of its faces in `order_`
        std::size_t skip = 0;            ///< the node after the subtree of this one
        point3 middle{};
        double radius = 0.0;  ///< radius of a ball around `middle` that contains its faces
        point3 dipole{};      ///< sum of their normals, weighted by area
    };

    void build(std::size_t begin, std::size_t end);
    void measure(node& n) const;
    [[nodiscard]] point3 middle_of(std::uint32_t f) const;
    [[nodiscard]] double sum_of(const node& n, const point3& q, std::uint32_t left_out) const;

    mesh_view mesh_;
    const std::vector<double>& times_;
    std::vector<std::uint32_t> order_{};  ///< faces that count
    std::vector<node> nodes_{};           ///< each node before its subtree
};

}  // namespace treeform::detail::boolean
