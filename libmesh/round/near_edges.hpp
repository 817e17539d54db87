#pragma once
/// \file
/// The edges of chosen faces of a surface.

#include <libmesh/base/fill_stars.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::round {

/// The edges of chosen faces, each with its uses, that is, the chosen faces at it.
///
/// \cost O(V + N) for N faces of V points
class near_edges {
  public:
    struct use {
        std::uint64_t edge;   ///< its ends as one number, the lower in the high bits
        std::uint32_t place;  ///< position of the face among the chosen ones
        int way;              ///< 1 if the face runs from the lower end to the higher, else -1
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
    base::faces_by_point<std::uint64_t, use> at_;  ///< by lower end, sorted
};

}  // namespace treeform::detail::round
