#include <libmesh/boolean/inside_of_cells.hpp>
#include <libmesh/boolean/sheet_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
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

void cover_from_both_sides(mesh_arrangement& cut, const std::vector<std::uint32_t>& operand_of_face,
                           std::uint32_t sheet) {
    std::vector<covering_face> covers;
    covers.reserve(2 * cut.covers.size());
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const auto before = cut.covers_of(f);
        cut.cover_begin[f] = covers.size();
        for (const covering_face& cover : before) {
            covers.push_back(cover);
            if (operand_of_face[cover.face] == sheet)
                covers.push_back({cover.face, !cover.opposite});
        }
    }
    cut.cover_begin.back() = covers.size();
    cut.covers = std::move(covers);
}

round::solid_faces kept_of_sheet(mesh_arrangement& cut, const arrangement_cells& cells,
                                 const std::vector<std::uint32_t>& operand_of_face,
                                 const std::vector<std::uint8_t>& way, std::uint32_t sheet,
                                 const boolean_expression& expression, fill_rule rule) {
    round::solid_faces kept;
    const auto in = std::make_unique<bool[]>(cells.operands);
    for (std::size_t f = 0; f < way.size(); ++f) {
        if (way[f] == 0) continue;
        const auto [front, behind] = cells.cell_of_side[f];
        for (std::size_t k = 0; k < cells.operands; ++k)
            in[k] = k == sheet || is_inside(rule, cells.winding_of(front)[k]) ||
                    is_inside(rule, cells.winding_of(behind)[k]);
        if (!expression({in.get(), cells.operands})) continue;
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
