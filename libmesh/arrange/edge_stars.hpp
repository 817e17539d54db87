#pragma once
/// \file
/// The faces at the lower end of each edge.

#include <libmesh/base/fill_stars.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::arrange {

/// For each point, the faces with three different corners in which it is a corner, but not the
/// highest: those with edges from it to higher points. So every edge is listed once, at its lower
/// end.
///
/// \pre  every corner is less than `point_count`, and there are less than 2^31 faces
/// \cost O(V + F) time, in parallel; 8 bytes a face and 4 a point; temporarily 16 more a face
/// \same on any number of threads
class edge_stars {
  public:
    edge_stars(std::size_t point_count, std::span<const face> faces);

    [[nodiscard]] std::size_t size() const { return at_.end.size(); }
    /// The faces at `point`, ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t point) const {
        return at_[point];
    }

  private:
    base::faces_by_point<std::uint32_t> at_;
};

}  // namespace treeform::detail::arrange
