#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/box_in_space.hpp>
#include <treeform/tree/detail/frame.hpp>
#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/detail/trees_side.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/refit.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

/// A tree is at least this many times as large as the next smaller one.
constexpr std::size_t ratio = 4;
/// Trees below this many slots join whatever is built.
constexpr std::size_t least_slots = 64;

/// The first of `ids`, all below `end`, that has come before; none when they differ.
std::optional<std::uint32_t> repeated(std::span<const std::uint32_t> ids, std::size_t end) {
    if (ids.size() < end / 128) {  // few: do not sweep memory for all
        std::vector<std::uint32_t> sorted(ids.begin(), ids.end());
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        return twice == sorted.end() ? std::nullopt : std::optional(*twice);
    }
    std::vector<bool> seen(end);
    for (const std::uint32_t id : ids) {
        if (seen[id]) return id;
        seen[id] = true;
    }
    return std::nullopt;
}

/// Sorts different ids, all below `end`.
void sort(std::vector<std::uint32_t>& ids, std::size_t end) {
    if (ids.size() < end / 128) return std::sort(ids.begin(), ids.end());
    std::vector<std::uint64_t> seen(chunk_count(end, 64));
    for (const std::uint32_t id : ids) seen[id / 64] |= std::uint64_t{1} << id % 64;
    auto to = ids.begin();
    for (std::uint32_t word = 0; word < seen.size(); ++word)
        for (std::uint64_t rest = seen[word]; rest != 0; rest &= rest - 1)
            *to++ = 64 * word + static_cast<std::uint32_t>(std::countr_zero(rest));
}

/// The first i in [0, count) for which `is_bad(i)`; `count` when there is none.
template <class IsBad>
std::size_t first_bad(std::size_t count, const IsBad& is_bad) {
    std::atomic<std::size_t> first{count};
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            if (is_bad(i)) return detail::lower(first, i);
    });
    return first.load();
}

template <std::size_t D>
bool holds(const aabb<double, D>& outer, const aabb<double, D>& inner) {
    for (std::size_t k = 0; k < D; ++k)
        if (!(outer.min[k] <= inner.min[k] && inner.max[k] <= outer.max[k])) return false;
    return true;
}

/// Boxes by id, for a refit.
template <std::size_t D>
struct boxes_by_id {
    const aabb<double, D>* boxes;

    const aabb<double, D>& operator()(std::uint32_t id) const { return boxes[id]; }
    void prefetch(std::uint32_t id) const {
        __builtin_prefetch(boxes[id].min.data());
        __builtin_prefetch(&boxes[id].max.back());
    }
};

}  // namespace

/// The level of the nodes above the leaf blocks, if there is one.
template <std::size_t D>
unsigned dynamic_tree<D>::packed::neighborhood_level() const {
    return boxes.levels() > 1 ? boxes.levels() - 2 : 0;
}

/// Limits decide what is cheap, not what is right: they are rounded as it comes.
template <std::size_t D>
void dynamic_tree<D>::packed::set_limits() {
    const std::span<const wide_node<D>> nodes = boxes.level(neighborhood_level());
    limits.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const detail::node_bounds<D> bounds(nodes[i]);
        double slack = 0.0;
        for (std::size_t k = 0; k < D; ++k)
            slack = std::max(slack, 0.25 * (static_cast<double>(bounds.max[k]) -
                                            static_cast<double>(bounds.min[k])));
        const auto in_space = [&](double x, std::size_t k) {
            return x / boxes.frame().scale + boxes.frame().origin[k];
        };
        for (std::size_t k = 0; k < D; ++k) {
            limits[i].min[k] = in_space(static_cast<double>(bounds.min[k]) - slack, k);
            limits[i].max[k] = in_space(static_cast<double>(bounds.max[k]) + slack, k);
        }
    }
}

template <std::size_t D>
bool dynamic_tree<D>::packed::may_hold(std::uint32_t place, const box_type& box) const {
    return holds(limits[place / boxes.capacity(neighborhood_level())], box);
}

template <std::size_t D>
std::vector<std::uint32_t> dynamic_tree<D>::insert(std::span<const box_type> boxes) {
    const std::size_t bad =
        first_bad(boxes.size(), [&](std::size_t i) { return !detail::is_finite(boxes[i]); });
    if (bad != boxes.size())
        throw std::invalid_argument("treeform::dynamic_tree: the box of element " +
                                    std::to_string(bad) + " is empty or not finite");
    if (boxes.size() > tree<D>::max_size - size())
        throw std::invalid_argument("treeform::dynamic_tree: " + std::to_string(boxes.size()) +
                                    " more elements are too many");
    std::vector<std::uint32_t> ids(boxes.size());
    const std::size_t again = std::min(free_.size(), boxes.size());
    std::copy_n(free_.rbegin(), again, ids.begin());
    free_.resize(free_.size() - again);
    for (std::size_t i = again; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(id_end_++);
    make_room(id_end_);
    for_chunks(ids.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) boxes_[ids[i]] = boxes[i];
    });
    settle(ids, std::vector<std::vector<std::uint32_t>>(parts_.size()));
    return ids;
}

/// For at least `ids` ids, growing by half, which makes the copies O(1) an id.
template <std::size_t D>
void dynamic_tree<D>::make_room(std::size_t ids) {
    const std::size_t now = boxes_.size();
    if (ids <= now) return;
    detail::buffer<box_type> boxes(std::max(ids, now + now / 2));
    detail::buffer<location> where(boxes.size());
    std::copy_n(boxes_.data(), now, boxes.data());
    std::copy_n(where_.data(), now, where.data());
    boxes_ = std::move(boxes);
    where_ = std::move(where);
}

template <std::size_t D>
void dynamic_tree<D>::remove(std::span<const std::uint32_t> ids) {
    check_ids("remove", ids);
    std::vector<std::vector<std::uint32_t>> touched(parts_.size());
    for (const std::uint32_t id : ids) {
        touched[where_[id].part].push_back(where_[id].place);
        vacate(id);
    }
    free_.insert(free_.end(), ids.begin(), ids.end());
    settle({}, touched);
}

template <std::size_t D>
void dynamic_tree<D>::move(std::span<const std::uint32_t> ids, std::span<const box_type> boxes) {
    if (ids.size() != boxes.size())
        throw std::invalid_argument("treeform::dynamic_tree: " + std::to_string(ids.size()) +
                                    " ids but " + std::to_string(boxes.size()) + " boxes");
    check_ids("move", ids);
    const std::size_t bad =
        first_bad(ids.size(), [&](std::size_t i) { return !detail::is_finite(boxes[i]); });
    if (bad != ids.size())
        throw std::invalid_argument("treeform::dynamic_tree: the box of id " +
                                    std::to_string(ids[bad]) + " is empty or not finite");
    constexpr std::size_t ahead = 16;  // where they are, and what they were, is anywhere in memory
    std::vector<location> at(ids.size());
    std::vector<std::uint8_t> stays(ids.size());
    for_chunks(ids.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            if (i + ahead < end) {
                __builtin_prefetch(&where_[ids[i + ahead]]);
                boxes_by_id<D>{boxes_.data()}.prefetch(ids[i + ahead]);
            }
            at[i] = where_[ids[i]];
            stays[i] = parts_[at[i].part].may_hold(at[i].place, boxes[i]);
            boxes_[ids[i]] = boxes[i];
        }
    });
    std::vector<std::vector<std::uint32_t>> touched(parts_.size());
    std::vector<std::uint32_t> pending;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        touched[at[i].part].push_back(at[i].place);
        if (stays[i]) continue;
        vacate(ids[i]);
        pending.push_back(ids[i]);
    }
    counts_.refitted += ids.size() - pending.size();
    settle(std::move(pending), touched);
}

template <std::size_t D>
void dynamic_tree<D>::check_ids(const char* function, std::span<const std::uint32_t> ids) const {
    const auto refuse = [&](std::uint32_t id, const char* why) {
        throw std::invalid_argument(std::string("treeform::dynamic_tree: cannot ") + function +
                                    " id " + std::to_string(id) + why);
    };
    const std::size_t bad = first_bad(ids.size(), [&](std::size_t i) { return !contains(ids[i]); });
    if (bad != ids.size()) refuse(ids[bad], ", which is not in the tree");
    if (const auto twice = repeated(ids, id_end())) refuse(*twice, " twice");
}

/// The slot is emptied when its tree is refitted, in leaf order.
template <std::size_t D>
void dynamic_tree<D>::vacate(std::uint32_t id) {
    const auto [from, place] = std::exchange(where_[id], {0, detail::no_primitive});
    parts_[from].boxes.ids_data()[place] = detail::no_primitive;
    --parts_[from].live;
    ++counts_.vacated;
}

/// Restores what the class promises, with `pending` in no tree and the slots at `touched`, by part,
/// out of date.
template <std::size_t D>
void dynamic_tree<D>::settle(std::vector<std::uint32_t> pending,
                             const std::vector<std::vector<std::uint32_t>>& touched) {
    const auto is_due = [&](const packed& one) {
        const bool is_small = one.boxes.size() < std::max(least_slots, ratio * pending.size());
        return !one.boxes.empty() &&
               (2 * one.live < one.boxes.size() || (!pending.empty() && is_small));
    };
    const auto next_due = [&] { return std::find_if(parts_.begin(), parts_.end(), is_due); };
    for (auto due = next_due(); due != parts_.end(); due = next_due()) dissolve(*due, pending);
    for (std::size_t i = 0; i < touched.size(); ++i) {
        tree<D>& boxes = parts_[i].boxes;
        if (boxes.empty() || touched[i].empty()) continue;
        const std::vector<detail::leaf_slots> slots = detail::slots_at(touched[i], boxes.size());
        (void)detail::refit_slots<D>(boxes, slots, boxes_by_id<D>{boxes_.data()});
        parts_[i].changed = true;
    }
    if (!pending.empty()) {
        sort(pending, id_end_);  // a build reads the boxes in this order
        build_part(pending);
    }
    cover_parts();
}

/// Takes the primitives of a tree, in leaf order.
template <std::size_t D>
void dynamic_tree<D>::dissolve(packed& from, std::vector<std::uint32_t>& to) {
    to.reserve(to.size() + from.live);
    for (const std::uint32_t id : from.boxes.ids())
        if (id != detail::no_primitive) to.push_back(id);
    from = {};
}

template <std::size_t D>
void dynamic_tree<D>::build_part(const std::vector<std::uint32_t>& ids) {
    auto unused = std::find_if(parts_.begin(), parts_.end(),
                               [](const packed& one) { return one.boxes.empty(); });
    if (unused == parts_.end()) unused = parts_.insert(parts_.end(), packed{});
    builder<D>{}.rebuild(unused->boxes, ids,
                         [&](std::uint32_t id) -> const box_type& { return boxes_[id]; });
    const auto number = static_cast<std::uint32_t>(unused - parts_.begin());
    std::uint32_t* const in_order = unused->boxes.ids_data();
    for_chunks(ids.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t place = begin; place < end; ++place) {
            in_order[place] = ids[in_order[place]];
            where_[in_order[place]] = {number, static_cast<std::uint32_t>(place)};
        }
    });
    unused->live = ids.size();
    unused->set_limits();
    unused->changed = true;
    counts_.built += ids.size();
}

/// Builds the top anew, unless the parts that have changed reach as far as they did.
template <std::size_t D>
void dynamic_tree<D>::cover_parts() {
    roots_.resize(parts_.size());
    bool reach_the_same = true;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!std::exchange(parts_[i].changed, false)) continue;
        const box_type root = detail::box_of_root(parts_[i].boxes);
        reach_the_same = reach_the_same && root == roots_[i];
        roots_[i] = root;
    }
    if (!reach_the_same) top_ = detail::tree_in_order(std::span<const box_type>(roots_));
}

template class dynamic_tree<2>;
template class dynamic_tree<3>;

}  // namespace treeform
