#include <libmesh/arrange/patches.hpp>
#include <libmesh/arrange/winding_beside.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/sheet_labels.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::size_t lines_a_chunk = 16;

}  // namespace

sheet_labels::sheet_labels(const bundles& operands, const interaction_zone& near,
                           mesh_arrangement& cut, const far_faces& far)
    : operands_(operands), near_(near), cut_(cut), far_(far), way_(cut.faces.size(), 0) {
    for (const bundle& operand : operands)
        if (!operand.view().faces.empty())
            box_.include(box_of_root(build_face_tree(*operand.mesh)));
    for (std::size_t f = 0; f < way_.size(); ++f) {
        const auto first = cut.covers.begin() + static_cast<std::ptrdiff_t>(cut.cover_begin[f]);
        const auto end = cut.covers.begin() + static_cast<std::ptrdiff_t>(cut.cover_begin[f + 1]);
        const auto of_sheet =
            std::find_if(first, end, [&](const covering_face& c) { return is_of_sheet(c.face); });
        if (of_sheet == end) continue;
        way_[f] = of_sheet->opposite ? 2 : 1;
        std::iter_swap(first, of_sheet);
    }
}

bool sheet_labels::keeps(const arrange::escape_ray& out, std::span<const covering_face> covers,
                         const boolean_expression& expression, fill_rule rule) const {
    const std::size_t count = expression.operand_count();
    const bundle& solids = operands_[1];
    std::vector<std::int64_t> winding(count, 0);
    arrange::visit_beside(
        build_face_tree(*solids.mesh),
        [&](std::uint32_t f) { return base::triangle_of(solids.view(), f); }, out.line,
        arrange::way_along(out.line, out.ahead), out.ahead,
        [&](std::uint32_t f, int change) { winding[solids.operand_of(f)] += change; });
    const auto in = std::make_unique<bool[]>(count);
    const auto enter = [&] {
        for (std::size_t k = 0; k < count; ++k) in[k] = in[k] || is_inside(rule, winding[k]);
    };
    enter();
    const int across = (out.line.faces() > 0) == out.ahead ? 1 : -1;
    for (const covering_face& cover : covers)
        if (!is_of_sheet(cover.face))
            winding[solids.operand_of(near_.face_of[cover.face] -
                                      operands_[0].view().faces.size())] +=
                cover.opposite ? -across : across;
    enter();
    in[operands_[0].operand] = true;
    return expression({in.get(), count});
}

chosen_surface sheet_labels::choose(const boolean_expression& expression, fill_rule rule) const {
    std::vector<std::uint32_t> is_of_solid(near_.local.faces.size(), 0);
    std::fill(is_of_solid.begin() + near_.first_of_b, is_of_solid.end(), 1U);
    const arrange::surface_patches patches = arrange::find_patches(cut_, is_of_solid);
    std::vector<std::uint32_t> asked;  // the first face of the sheet in each patch
    std::vector<std::uint8_t> is_asked(patches.count(), 0), kept(patches.count(), 0);
    for (std::uint32_t f = 0; f < way_.size(); ++f)
        if (way_[f] != 0 && std::exchange(is_asked[patches.patch[f]], 1) == 0) asked.push_back(f);
    for_chunks(asked.size(), lines_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t f = asked[i];
            kept[patches.patch[f]] = keeps(arrange::find_escape_ray(near_.local, cut_, f, box_),
                                           cut_.covers_of(f), expression, rule);
        }
    });
    chosen_surface chosen;
    for (std::uint32_t f = 0; f < way_.size(); ++f) {
        if (way_[f] == 0 || kept[patches.patch[f]] == 0) continue;
        const auto& [a, b, c] = cut_.faces[f];
        chosen.near.faces.push_back(way_[f] == 1 ? face{a, b, c} : face{a, c, b});
        chosen.near.face_of.push_back(f);
    }
    const mesh_view sheet = operands_[0].view();
    std::vector<disposition> of_set(far_.faces().size());
    for_chunks(of_set.size(), lines_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const triangle3 t = base::triangle_of(sheet, far_.faces()[i]);
            of_set[i] =
                keeps(arrange::find_escape_ray({t[0], t[1], t[2]}, t, box_), {}, expression, rule)
                    ? disposition::kept
                    : disposition::dropped;
        }
    });
    chosen.dispositions =
        buffer<disposition>(sheet.faces.size() + operands_[1].view().faces.size());
    std::fill_n(chosen.dispositions.data(), chosen.dispositions.size(), disposition::dropped);
    far_.write(std::span<const disposition>(of_set), chosen.dispositions.data());
    for (const std::uint32_t f : near_.face_of) chosen.dispositions[f] = disposition::cut;
    return chosen;
}

}  // namespace treeform::detail::boolean
