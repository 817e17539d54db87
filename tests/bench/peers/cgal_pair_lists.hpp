#pragma once
/// \file
/// The pairs of faces that meet by CGAL, as lists.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace treeform::bench {

/// Numbers of faces, the lower one first, ascending.
using pair_list = std::vector<std::array<std::uint32_t, 2>>;

/// A surface mesh of the kernel EPICK or EPECK, converted before.
class cgal_surface {
  public:
    virtual ~cgal_surface() = default;
    /// What `PMP::self_intersections` finds, except for faces that are degenerate.
    [[nodiscard]] virtual pair_list pairs() const = 0;
};

/// None where half-edges cannot hold the mesh as it is.
[[nodiscard]] std::shared_ptr<const cgal_surface> cgal_surface_of(const mesh& mesh, bool exact);

}  // namespace treeform::bench
