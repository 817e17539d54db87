#pragma once
/// \file
/// Finds holes of a surface, and fills them with triangles.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// A lookup table of the directed edges of faces.
class directed_edges {
  public:
    explicit directed_edges(std::span<const face> faces);

    /// The lowest face, from number `from` on, that runs from u to v; or none.
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

/// The rims of holes: closed sequences of points along border edges, in the direction of the faces
/// that will fill them. A rim that returns to one of its points is split there.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> find_rims(std::span<const face> faces,
                                                                const directed_edges& edges);

/// Triangles between the points of the rim that close it, of the least total area for up to 200
/// points; none if every such set would repeat an edge.
[[nodiscard]] std::vector<face> fill(std::span<const point3> points,
                                     const std::vector<std::uint32_t>& rim,
                                     const directed_edges& edges);

}  // namespace treeform::detail::repair
