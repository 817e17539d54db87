#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/boolean/operand_tree.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/numbers.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail::boolean {

std::optional<tree<3>> tree_of_operands(std::span<const mesh_view> operands) {
    if (operands.empty() || operands.size() > 2) return std::nullopt;
    std::size_t count = 0;
    for (const mesh_view& operand : operands) {
        if (!arrange::can_all_be_arranged(operand)) return std::nullopt;
        count += operand.faces.size();
    }
    if (count > tree<3>::max_size) return std::nullopt;
    const mesh_view &first = operands.front(), &last = operands.back();
    const std::size_t first_of_last = count - last.faces.size();
    return build(numbers(count), [&](std::size_t f) {
        const bool is_last = f >= first_of_last;
        const mesh_view& operand = is_last ? last : first;
        aabb<double, 3> box;
        for (const std::uint32_t corner : operand.faces[is_last ? f - first_of_last : f])
            box.include(operand.points[corner]);
        return box;
    });
}

}  // namespace treeform::detail::boolean
