#include <libmesh/intersect/height_field.hpp>
#include <libmesh/intersect/height_field_nodes.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>

namespace treeform::detail::intersect {

namespace {

/// A node is tested before those below it.
class field_marker {
  public:
    field_marker(points_view points, std::span<const numbered_face> faces, const tree<3>& tree,
                 detail::node_marks<3>& found)
        : test_(points), faces_(faces), tree_(tree), found_(found) {}

    void settle(unsigned level, std::size_t node) {
        const std::size_t first = node * tree_.capacity(level);
        const std::size_t count = std::min(tree_.capacity(level), faces_.size() - first);
        if (test_(faces_.subspan(first, count))) return found_.mark(level, node);
        if (level + 1 >= tree_.levels() || tree_.is_leaf_level(level + 1)) return;
        for (std::size_t i = 0; i < tree_.child_count(level, node); ++i)
            settle(level + 1, tree_.width * node + i);
    }

  private:
    height_field_test test_;
    std::span<const numbered_face> faces_;
    const tree<3>& tree_;
    detail::node_marks<3>& found_;
};

}  // namespace

detail::node_marks<3> find_height_fields(points_view points, std::span<const numbered_face> faces,
                                         const tree<3>& tree) {
    detail::node_marks<3> found(tree);
    if (tree.empty()) return found;
    unsigned top = 0;
    while (!tree.is_leaf_level(top) && tree.capacity(top) > height_field_test::max_faces) ++top;
    for_chunks(tree.nodes_in_level(top), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto marker = std::make_unique<field_marker>(points, faces, tree, found);
        for (std::size_t node = begin; node < end; ++node) marker->settle(top, node);
    });
    return found;
}

}  // namespace treeform::detail::intersect
