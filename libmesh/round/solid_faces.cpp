#include <libmesh/round/detail/solid_faces.hpp>

#include <cstddef>

namespace tf::detail {

solid_faces faces_around(const mesh_arrangement& cut, const arrangement_cells& cells,
                         const std::vector<std::uint8_t>& inside) {
    solid_faces result;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const auto [front, behind] = cells.cell_of_side[f];
        if (inside[front] == inside[behind]) continue;
        const auto [a, b, c] = cut.faces[f];
        result.faces.push_back(inside[behind] != 0 ? face{a, b, c} : face{a, c, b});
        result.face_of.push_back(static_cast<std::uint32_t>(f));
    }
    return result;
}

}  // namespace tf::detail
