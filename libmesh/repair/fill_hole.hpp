#pragma once
/// \file
/// Holes of a surface and triangles that close them.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// Edges as faces run along them, to be looked up.
class directed_edges {
  public:
    explicit directed_edges(std::span<const face> faces);

    /// The lowest face that runs from u to v and is not below `from`, or none.
    [[nodiscard]] std::uint32_t face_along(std::uint32_t u, std::uint32_t v,
                                           std::uint32_t from = 0) const;
    [[nodiscard]] bool has(std::uint32_t u, std::uint32_t v) const;

    static constexpr std::uint32_t none = 0xFFFFFFFF;

  private:
    struct edge {
        std::array<std::uint32_t, 2> ends;
        std::uint32_t face;
    };
    std::vector<edge> edges_;
};

/// The rims of holes: closed ways of points along which faces run on one side only, each in the
/// direction in which the faces that fill it will run. A rim that comes back to one of its points
/// is cut there into several.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> find_rims(std::span<const face> faces,
                                                                const directed_edges& edges);

/// Triangles between the points of the rim that close it, of the least total area for up to 200
/// points; none when every way to do so would double an edge.
[[nodiscard]] std::vector<face> fill(std::span<const point3> points,
                                     const std::vector<std::uint32_t>& rim,
                                     const directed_edges& edges);

}  // namespace treeform::detail::repair
