#include <libmesh/base/compact.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/round/solid_faces.hpp>

#include <cstddef>

namespace treeform::detail::round {

solid_faces faces_around(const mesh_arrangement& cut, const arrangement_cells& cells,
                         const std::vector<std::uint8_t>& inside) {
    solid_faces result;
    base::compact(
        cut.faces.size(),
        [&](std::size_t f) {
            const auto [front, behind] = cells.cell_of_side[f];
            return inside[front] != inside[behind];
        },
        [&](std::size_t count) {
            base::parallel_invoke([&] { result.faces.resize(count); },
                                  [&] { result.face_of.resize(count); });
        },
        [&](std::size_t f, std::size_t place) {
            const auto [a, b, c] = cut.faces[f];
            const bool is_behind = inside[cells.cell_of_side[f][1]] != 0;
            result.faces[place] = is_behind ? face{a, b, c} : face{a, c, b};
            result.face_of[place] = static_cast<std::uint32_t>(f);
        });
    return result;
}

}  // namespace treeform::detail::round
