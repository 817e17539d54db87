#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/detail/trees_side.hpp>
#include <treeform/tree/refit.hpp>

#include <algorithm>
#include <vector>

namespace treeform::detail {
namespace {

template <std::size_t D>
struct boxes_in_order {
    std::span<const aabb<double, D>> boxes;

    const aabb<double, D>& operator()(std::uint32_t id) const { return boxes[id]; }
    void prefetch(std::uint32_t) const {}
};

}  // namespace

template <std::size_t D>
tree<D> tree_in_order(std::span<const aabb<double, D>> boxes) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].empty()) ids.push_back(i);
    tree<D> result;
    if (ids.empty()) return result;
    result.reset(ids.size());
    result.set_frame(frame_of<D>(
        ids.size(), [&](std::size_t i) -> const auto& { return boxes[ids[i]]; }));
    std::copy(ids.begin(), ids.end(), result.ids_data());
    for (unsigned level = 0; level < result.levels(); ++level) {
        wide_node<D>& last = result.level_data(level)[result.nodes_in_level(level) - 1];
        for (std::size_t slot = 0; slot < tree<D>::width; ++slot) clear_slot(last, slot);
    }
    (void)refit_all(result, boxes_in_order<D>{boxes});
    return result;
}

template tree<2> tree_in_order(std::span<const aabb<double, 2>>);
template tree<3> tree_in_order(std::span<const aabb<double, 3>>);

}  // namespace treeform::detail
