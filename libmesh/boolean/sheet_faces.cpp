#include <libmesh/boolean/sheet_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {

std::vector<std::uint8_t> sheet_faces(const mesh_arrangement& cut,
                                      const std::vector<std::uint32_t>& operand_of_face,
                                      std::uint32_t sheet) {
    std::vector<std::uint8_t> way(cut.faces.size(), 0);
    for (std::size_t f = 0; f < way.size(); ++f)
        for (const auto& [face, opposite] : cut.covers_of(f))
            if (operand_of_face[face] == sheet) {
                way[f] = opposite ? 2 : 1;
                break;
            }
    return way;
}

round::solid_faces kept_of_sheet(mesh_arrangement& cut,
                                 const std::vector<std::uint32_t>& operand_of_face,
                                 const std::vector<std::uint8_t>& way,
                                 const std::vector<std::uint8_t>& keep, std::uint32_t sheet) {
    round::solid_faces kept;
    for (std::size_t f = 0; f < way.size(); ++f) {
        if (way[f] == 0 || keep[f] == 0) continue;
        auto first = cut.covers.begin() + static_cast<std::ptrdiff_t>(cut.cover_begin[f]);
        for (auto at = first; operand_of_face[first->face] != sheet; ++at)
            if (operand_of_face[at->face] == sheet) std::iter_swap(first, at);
        const auto [a, b, c] = cut.faces[f];
        kept.faces.push_back(way[f] == 1 ? face{a, b, c} : face{a, c, b});
        kept.face_of.push_back(static_cast<std::uint32_t>(f));
    }
    return kept;
}

}  // namespace treeform::detail::boolean
