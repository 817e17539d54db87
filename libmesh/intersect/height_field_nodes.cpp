#include <libmesh/intersect/height_field.hpp>
#include <libmesh/intersect/height_field_nodes.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>

namespace treeform::detail::intersect {

node_marks<3> find_height_fields(points_view points, std::span<const numbered_face> faces,
                                 const tree<3>& tree) {
    node_marks<3> found(tree);
    if (tree.empty()) return found;
    unsigned top = 0;
    while (!tree.is_leaf_level(top) && tree.capacity(top) > height_field_test::max_faces) ++top;
    for_chunks(tree.nodes_in_level(top), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
        height_field_test test(points);
        const auto settle = [&](unsigned level, std::size_t node) {
            const std::size_t first = node * tree.capacity(level);
            const std::size_t count = std::min(tree.capacity(level), faces.size() - first);
            const bool is_field = test(faces.subspan(first, count));
            if (is_field) found.mark(level, node);
            return is_field;
        };
        for (std::size_t node = begin; node < end; ++node) {
            if (settle(top, node)) continue;
            const unsigned below = top + 1;
            if (below >= tree.levels() || tree.is_leaf_level(below)) continue;
            for (std::size_t i = 0; i < tree.children(top, node); ++i)
                settle(below, tree.width * node + i);
        }
    });
    return found;
}

}  // namespace treeform::detail::intersect
