#include <libmesh/arrange/edge_stars.hpp>
#include <libmesh/base/stars.hpp>

#include <algorithm>

namespace treeform::detail::arrange {

edge_stars::edge_stars(std::size_t point_count, std::span<const face> faces)
    : at_(base::fill_stars<std::uint32_t>(
          base::nameable_points(point_count), faces.size(), [&](std::size_t i, const auto& visit) {
              if (!base::has_three_corners(faces[i])) return;
              const auto& [a, b, c] = faces[i];
              const std::uint32_t low = std::min(std::min(a, b), c);
              const std::uint32_t high = std::max(std::max(a, b), c);
              visit(low);
              visit(a ^ b ^ c ^ low ^ high);
          })) {}

}  // namespace treeform::detail::arrange
