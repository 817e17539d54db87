#include <libmesh/base/double_double.hpp>
#include <libmesh/boolean/inside_of_cells.hpp>
#include <libmesh/boolean/sum_of_cones.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace treeform::detail::boolean {
namespace {

/// The volume of the cells that are inside, from the points as approximated.
double volume_of(const mesh_arrangement& cut, const arrangement_cells& cells,
                 const std::vector<std::uint8_t>& inside) {
    const std::size_t given = cut.given_points.size();
    const auto at = [&](std::uint32_t p) {
        return p < given ? cut.given_points[p] : cut.constructed[p - given].center();
    };
    const auto sum = sum_of_cones(cut.faces.size(), [&](std::size_t f) {
        const auto [front, behind] = cells.cell_of_side[f];
        if (inside[front] == inside[behind]) return base::double_double{};
        const auto [p, q, r] = cut.faces[f];
        const base::double_double cone = base::determinant(at(p), at(q), at(r));
        return inside[behind] != 0 ? cone : -cone;
    });
    return sum.high / 6.0;
}

/// Whether the operand winds 0 times around each cell or else the same once.
bool winds_once(const arrangement_cells& cells, std::size_t operand) {
    std::array<bool, 2> winds{};
    for (std::size_t i = operand; i < cells.winding.size(); i += cells.operands) {
        const std::int32_t winding = cells.winding[i];
        if (std::abs(winding) > 1) return false;
        if (winding != 0) winds[winding > 0 ? 1 : 0] = true;
    }
    return !winds[0] || !winds[1];
}

}  // namespace

bool is_inside(fill_rule rule, std::int32_t winding) {
    switch (rule) {
        case fill_rule::odd:
            return winding % 2 != 0;
        case fill_rule::positive:
            return winding > 0;
        case fill_rule::nonzero:
            break;
    }
    return winding != 0;
}

std::vector<std::uint8_t> inside_of_cells(const arrangement_cells& cells, fill_rule rule,
                                          const boolean_expression& expression) {
    const std::size_t operands = cells.operands;
    const std::size_t count = operands == 0 ? 1 : cells.winding.size() / operands;
    std::vector<std::uint8_t> inside(count, 0);
    constexpr std::size_t grain = std::size_t{1} << 10;
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto in = std::make_unique<bool[]>(operands);
        for (std::size_t c = begin; c < end; ++c) {
            const auto windings = cells.winding_of(static_cast<std::uint32_t>(c));
            for (std::size_t k = 0; k < operands; ++k) in[k] = is_inside(rule, windings[k]);
            inside[c] = expression({in.get(), operands}) ? 1 : 0;
        }
    });
    return inside;
}

operand_volumes find_volumes(std::span<const mesh_view> operands, const mesh_arrangement& cut,
                             const arrangement_cells& cells, fill_rule rule) {
    const auto volume = [&](const char* text) {
        return volume_of(cut, cells, inside_of_cells(cells, rule, {text, 2}));
    };
    const auto volume_of_one = [&](std::size_t operand) {
        const bool any_way = rule != fill_rule::positive;
        if (winds_once(cells, operand) && any_way)
            return std::abs(signed_volume(operands[operand]));
        return volume(operand == 0 ? "a" : "b");
    };
    return {volume_of_one(0), volume_of_one(1), volume("a+b"), volume("a*b")};
}

}  // namespace treeform::detail::boolean
