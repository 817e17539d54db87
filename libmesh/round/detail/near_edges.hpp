#pragma once
/// \file
/// The edges of some faces of a surface.

#include <libmesh/mesh.hpp>
#include <libtree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tf::detail {

/// The edges of chosen faces, each with its uses: the chosen faces it is an edge of.
///
/// \cost O(N log N) for N faces
class near_edges {
  public:
    struct use {
        std::uint32_t low, high;  ///< ends, the lower first
        std::uint32_t place;      ///< of the face among those chosen
        int way;                  ///< 1 when the face runs from `low` to `high`, else -1

        [[nodiscard]] bool same_edge(const use& u) const { return low == u.low && high == u.high; }
    };

    /// `faces` are numbers of faces of the surface. Both outlive this.
    near_edges(mesh_view surface, std::span<const std::uint32_t> faces);

    [[nodiscard]] std::span<const std::uint32_t> faces() const { return faces_; }

    /// Calls `visit(uses)` once for each edge, from several threads; uses ascend by place.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for_chunks(parts_.size(), 1, [&](std::size_t part, std::size_t, std::size_t) {
            const std::span<const use> uses = parts_[part];
            for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
                while (end < uses.size() && uses[end].same_edge(uses[begin])) ++end;
                visit(uses.subspan(begin, end - begin));
            }
        });
    }

  private:
    std::span<const std::uint32_t> faces_;
    std::vector<std::vector<use>> parts_;  ///< sorted; all uses of an edge in one
};

}  // namespace tf::detail
