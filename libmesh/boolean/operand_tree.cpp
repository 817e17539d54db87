#include <libmesh/arrange/detail/arrange_pairs.hpp>
#include <libmesh/boolean/detail/operand_tree.hpp>
#include <libtree/aabb.hpp>
#include <libtree/build.hpp>
#include <libtree/detail/numbers.hpp>

#include <cstddef>
#include <cstdint>

namespace tf::detail {

std::optional<tree<3>> tree_of_operands(std::span<const mesh_view> operands) {
    if (operands.empty() || operands.size() > 2) return std::nullopt;
    std::size_t count = 0;
    for (const mesh_view& operand : operands) {
        if (!can_all_be_arranged(operand)) return std::nullopt;
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

}  // namespace tf::detail
