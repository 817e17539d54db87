#pragma once
/// \file
/// The edges of some faces of a surface.

#include <libmesh/base/fill_stars.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// The edges of chosen faces, each with its uses: the chosen faces it is an edge of.
///
/// \cost O(V + N) for N faces of V points
class near_edges {
  public:
    struct use {
        std::uint64_t edge;   ///< its ends, the lower in front, as one number
        std::uint32_t place;  ///< of the face among those chosen
        int way;              ///< 1 when the face runs from the lower end to the higher, else -1
    };

    /// `faces` are numbers of faces of the surface. Both outlive this.
    near_edges(mesh_view surface, std::span<const std::uint32_t> faces);

    [[nodiscard]] std::span<const std::uint32_t> faces() const { return faces_; }

    /// Calls `visit(uses)` once for each edge, from several threads; uses ascend by place.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for_chunks(at_.end.size(), grain, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t p = first; p < last; ++p) {
                const std::span<const use> uses = at_[p];
                for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
                    while (end < uses.size() && uses[end].edge == uses[begin].edge) ++end;
                    visit(uses.subspan(begin, end - begin));
                }
            }
        });
    }

  private:
    static constexpr std::size_t grain = std::size_t{1} << 8;  ///< points

    std::span<const std::uint32_t> faces_;
    base::faces_by_point<std::uint64_t, use> at_;  ///< at lower ends, sorted
};

}  // namespace treeform::detail::round
