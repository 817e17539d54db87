#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/nearness.hpp>

#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libtree/query/nearness.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as it is compiled for each target.
#include <libtree/query/near_walk-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::HWY_NAMESPACE {
namespace {

template <class Order, std::size_t D>
void approach_by(const tree<D>& t, const near_query<D>& query, double squared,
                 function_ref<double(std::uint32_t)> visit) {
    typename Order::template frontier<near_entry, near_depth> frontier;
    const std::uint32_t* const ids = t.ids().data();
    const wide_node<D>* const blocks = t.level(t.levels() - 1).data();
    const auto leaf = [&](std::uint32_t block, float& bound) {
        alignas(64) float lower[8];
        std::array<std::uint8_t, 8> slots;
        const unsigned mask = near_mask(blocks[block], query.low, query.high, bound, lower);
        const std::size_t count = nearest_first(mask, lower, slots);
        for (std::size_t i = 0; i < count && lower[slots[i]] <= bound; ++i) {
            const double now = visit(ids[block * 8 + slots[i]]);
            if (now == squared) continue;
            squared = now;
            bound = query.bound_of(now);
        }
    };
    walk_near(t, query, query.bound_of(squared), frontier, leaf);
}

template <std::size_t D>
void approach_any(const tree<D>& t, const near_query<D>& query, double squared, node_order order,
                  function_ref<double(std::uint32_t)> visit) {
    switch (order) {
        case node_order::depth_first:
            return approach_by<strategy::depth_first>(t, query, squared, visit);
        case node_order::top_k_sorted:
            return approach_by<strategy::top_k_sorted>(t, query, squared, visit);
        case node_order::best_first:
            return approach_by<strategy::priority_queue>(t, query, squared, visit);
    }
}

void approach_2(const tree<2>& t, const near_query<2>& query, double squared, node_order order,
                function_ref<double(std::uint32_t)> visit) {
    approach_any(t, query, squared, order, visit);
}
void approach_3(const tree<3>& t, const near_query<3>& query, double squared, node_order order,
                function_ref<double(std::uint32_t)> visit) {
    approach_any(t, query, squared, order, visit);
}

}  // namespace
}  // namespace treeform::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail {
namespace {

HWY_EXPORT(approach_2);
HWY_EXPORT(approach_3);

void dispatch(const tree<2>& t, const near_query<2>& query, double squared, node_order order,
              function_ref<double(std::uint32_t)> visit) {
    HWY_DYNAMIC_DISPATCH(approach_2)(t, query, squared, order, visit);
}
void dispatch(const tree<3>& t, const near_query<3>& query, double squared, node_order order,
              function_ref<double(std::uint32_t)> visit) {
    HWY_DYNAMIC_DISPATCH(approach_3)(t, query, squared, order, visit);
}

}  // namespace

template <std::size_t D>
void walk_near(const tree<D>& tree, const aabb<double, D>& query, double squared, node_order order,
               function_ref<double(std::uint32_t)> visit) {
    if (!is_finite(query))
        throw std::invalid_argument("treeform::nearness: the query is not finite, or an empty box");
    if (tree.empty() || squared < 0.0) return;
    dispatch(tree, near_query<D>(tree.frame(), query), squared, order, visit);
}

template TREEFORM_API void walk_near(const tree<2>&, const aabb<double, 2>&, double, node_order,
                                     function_ref<double(std::uint32_t)>);
template TREEFORM_API void walk_near(const tree<3>&, const aabb<double, 3>&, double, node_order,
                                     function_ref<double(std::uint32_t)>);

}  // namespace treeform::detail
#endif
