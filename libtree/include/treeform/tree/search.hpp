#pragma once
/// \file
/// Search of any kind of tree by a box, or by anything that can be held against a box. With the
/// headers included here, all searches: `search`, `search_any`, `search_all` by one query and of
/// two trees; `search_self`, `search_self_any`, `search_self_all`; and by blocks, `search_broad` by
/// one query and of two trees, `search_self_broad`.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/detail/visit_query.hpp>
#include <treeform/tree/search_pair.hpp>
#include <treeform/tree/search_self.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

/// Calls `apply(id)` for the primitives that `query` may want, in leaf order, until it returns true
/// (it may return nothing). Returns what was looked at.
///
/// A box wants the primitives whose boxes overlap it, touching included. A check, called with boxes
/// in the coordinates of the primitives, wants what lies below nodes and in boxes for which it is
/// true; it must be true for a box around any box for which it is. Boxes are those of the tree,
/// rounded outward: none is missed, and some come that miss by less than that rounding. An empty
/// box wants nothing, an infinite one may be asked for.
///
/// \throws std::invalid_argument when a box has a coordinate that is NaN
/// \cost   O(log N + P) for P primitives, on a query no larger than they are
/// \same   in every run; runs on the calling thread, and any number may run at the same time
/// \source Sajovic, Knez and Korez, tf::tree, section III-C
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Apply>
search_statistics search(const Tree& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](const std::uint32_t* ids, unsigned mask) {
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            if (detail::asks_to_stop(apply, ids[std::countr_zero(rest)])) return true;
        return false;
    });
}

/// The same a leaf block at a time: `apply(ids)` with the up to 8 primitives of a block that the
/// query may want, as a `std::span<const std::uint32_t>`.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Apply>
search_statistics search_broad(const Tree& tree, const Query& query, const Apply& apply) {
    return detail::visit_query(tree, query, [&](const std::uint32_t* ids, unsigned mask) {
        std::array<std::uint32_t, 8> wanted;
        std::size_t count = 0;
        for (unsigned rest = mask; rest != 0; rest &= rest - 1)
            wanted[count++] = ids[std::countr_zero(rest)];
        return detail::asks_to_stop(apply, std::span<const std::uint32_t>(wanted.data(), count));
    });
}

/// Whether `accept(id)` is true for a primitive that `query` may want.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] bool search_any(const Tree& tree, const Query& query, const Accept& accept) {
    bool found = false;
    search(tree, query, [&](std::uint32_t id) { return found = accept(id); });
    return found;
}

/// The primitives that `query` may want and for which `accept(id)` is true, ascending.
template <any_tree Tree, tree_query<Tree::dimensions> Query, class Accept>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query,
                                                    const Accept& accept) {
    std::vector<std::uint32_t> found;
    search(tree, query, [&](std::uint32_t id) {
        if (accept(id)) found.push_back(id);
    });
    std::sort(found.begin(), found.end());
    return found;
}

/// The primitives that `query` may want, ascending.
template <any_tree Tree, tree_query<Tree::dimensions> Query>
[[nodiscard]] std::vector<std::uint32_t> search_all(const Tree& tree, const Query& query) {
    return search_all(tree, query, [](std::uint32_t) { return true; });
}

}  // namespace treeform
