#pragma once
/// \file
/// Generalized winding numbers: how much of the way around a point faces go, also where they do not
/// close.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::boolean {

/// Sums of solid angles of faces, over a tree: what is far off counts as one dipole.
///
/// For choices only: nothing of it is exact. It is the same wherever doubles are.
///
/// \cost   O(F log^2 F) to build, serial; a sum O(log F) in practice
/// \source Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside Segmentation using
///         Generalized Winding Numbers, SIGGRAPH 2013; Barill, Dickson, Schmidt, Levin and
///         Jacobson, Fast Winding Numbers for Soups and Clouds, SIGGRAPH 2018, for dipoles
class winding_sum {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// \param times [F] how often each face counts, negative where it is turned over
    /// \pre   coordinates are below 2^20; `mesh` and `times` outlive this
    winding_sum(mesh_view mesh, const std::vector<double>& times);

    /// About q, without the face `left_out`.
    [[nodiscard]] double around(const point3& q, std::uint32_t left_out = none) const;

  private:
    struct node {
        std::size_t begin = 0, end = 0;  ///< of its faces in `order_`
        std::size_t skip = 0;            ///< the node after all below this one
        point3 middle{};
        double radius = 0.0;  ///< of a ball around `middle` with all of its faces
        point3 dipole{};      ///< the sum of their normals, as long as their areas
    };

    void build(std::size_t begin, std::size_t end);
    void measure(node& n) const;
    [[nodiscard]] point3 middle_of(std::uint32_t f) const;
    [[nodiscard]] double sum_of(const node& n, const point3& q, std::uint32_t left_out) const;

    mesh_view mesh_;
    const std::vector<double>& times_;
    std::vector<std::uint32_t> order_{};  ///< faces that count
    std::vector<node> nodes_{};           ///< each before what is below it
};

}  // namespace treeform::detail::boolean
