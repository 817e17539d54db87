#include <libmesh/round/near_edges.hpp>

#include <algorithm>
#include <cstdint>

namespace treeform::detail::round {

near_edges::near_edges(mesh_view surface, std::span<const std::uint32_t> faces)
    : faces_(faces),
      at_(base::fill_lists<std::uint64_t, use>(
          surface.points.size(), faces.size(),
          [&](std::size_t place, const auto& visit) {
              const face& f = surface.faces[faces[place]];
              for (std::size_t i = 0; i < 3; ++i) {
                  const std::uint32_t a = f[i], b = f[i == 2 ? 0 : i + 1];
                  const std::uint32_t low = std::min(a, b);
                  const std::uint64_t edge = std::uint64_t{low} << 32 | std::max(a, b);
                  visit(low, {edge, static_cast<std::uint32_t>(place), a < b ? 1 : -1});
              }
          },
          [](std::span<use> uses) {
              std::sort(uses.begin(), uses.end(), [](const use& x, const use& y) {
                  return x.edge != y.edge ? x.edge < y.edge : x.place < y.place;
              });
          })) {}

}  // namespace treeform::detail::round
