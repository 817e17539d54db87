#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/boolean/leaf_blocks.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/search_self.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail::boolean {
namespace {

std::vector<aabb<double, 3>> boxes_of_blocks(const tree<3>& faces) {
    const unsigned leaves = faces.levels() - 1;
    if (leaves == 0) return {box_of_root(faces)};
    std::vector<aabb<double, 3>> boxes(faces.level(leaves).size());
    for (std::size_t b = 0; b < boxes.size(); ++b)
        boxes[b] =
            box_in_space(faces.frame(), faces.level(leaves - 1)[b / faces.width], b % faces.width);
    return boxes;
}

leaf_blocks find_blocks(const tree<3>& faces) {
    leaf_blocks result;
    result.index = build(boxes_of_blocks(faces), [](const aabb<double, 3>& box) { return box; });
    result.overlaps = search_self<std::vector<id_pair>>(
        result.index, [](std::vector<id_pair>& mine, std::uint32_t a, std::uint32_t b) {
            mine.emplace_back(a, b);
        });
    return result;
}

}  // namespace

const leaf_blocks& leaf_blocks_of(const prepared_mesh& mesh) {
    constexpr base::slot<leaf_blocks> slot{base::slot_name::leaf_blocks};
    return base::prepared_slots::get(mesh, slot,
                                     [&] { return find_blocks(build_face_tree(mesh)); });
}

}  // namespace treeform::detail::boolean
