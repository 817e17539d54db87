#pragma once
/// \file
/// The edges of some faces of a surface.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// The edges of chosen faces, each with its uses: the chosen faces it is an edge of.
///
/// \cost O(N log N) for N faces
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
        for_chunks(parts_.size(), 1, [&](std::size_t part, std::size_t, std::size_t) {
            const std::span<const use> uses = parts_[part];
            for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
                while (end < uses.size() && uses[end].edge == uses[begin].edge) ++end;
                visit(uses.subspan(begin, end - begin));
            }
        });
    }

  private:
    std::span<const std::uint32_t> faces_;
    std::vector<std::vector<use>> parts_;  ///< sorted; all uses of an edge in one
};

}  // namespace treeform::detail::round
