#include <libmesh/base/stars.hpp>

namespace treeform::detail::base {

stars::stars(std::size_t point_count, std::span<const face> faces)
    : at_(fill_stars<std::size_t>(nameable_points(point_count), faces.size(),
                                  [&](std::size_t i, const auto& visit) {
                                      if (!has_three_corners(faces[i])) return;
                                      for (const std::uint32_t corner : faces[i]) visit(corner);
                                  })) {}

}  // namespace treeform::detail::base
