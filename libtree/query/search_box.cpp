#include <treeform/tree/detail/visit_leaves.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/search_box.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as it is compiled for each target.
#include <libtree/query/overlap_mask-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

template <std::size_t D>
search_statistics visit(const tree<D>& tree, const aabb<float, D>& query, leaf_visitor at_leaf) {
    wide_node<D> box;  // in its slot 0
    for (std::size_t k = 0; k < D; ++k) {
        box.min[k][0] = query.min[k];
        box.max[k][0] = query.max[k];
    }
    return visit_leaves(
        tree, [&](const wide_node<D>& node, std::size_t) { return overlap_mask(node, box, 0); },
        at_leaf);
}

search_statistics visit_box_2(const tree<2>& tree, const aabb<float, 2>& query,
                              leaf_visitor at_leaf) {
    return visit(tree, query, at_leaf);
}
search_statistics visit_box_3(const tree<3>& tree, const aabb<float, 3>& query,
                              leaf_visitor at_leaf) {
    return visit(tree, query, at_leaf);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {

HWY_EXPORT(visit_box_2);
HWY_EXPORT(visit_box_3);

search_statistics visit_box(const tree<2>& tree, const aabb<float, 2>& query,
                            leaf_visitor at_leaf) {
    return HWY_DYNAMIC_DISPATCH(visit_box_2)(tree, query, at_leaf);
}
search_statistics visit_box(const tree<3>& tree, const aabb<float, 3>& query,
                            leaf_visitor at_leaf) {
    return HWY_DYNAMIC_DISPATCH(visit_box_3)(tree, query, at_leaf);
}

}  // namespace treeform::detail
#endif
