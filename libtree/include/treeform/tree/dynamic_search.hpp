#pragma once
/// \file
/// The searches by a box or a check, and for pairs, over a `dynamic_tree`: the same names, the same
/// answers as over a tree that has just been built. What the functions take and promise is said
/// where they are declared for `tree`; here stands what differs. What is near is sought by
/// dynamic_nearness.hpp, along rays by dynamic_ray.hpp.
///
/// Primitives are ids of the dynamic tree. Where a search hands out in an order of its own, it
/// goes through the trees one by one, each in its leaf order. No search may run during an update.

#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace treeform {

// By a box or a check; with `search` come `search_any` and `search_all`.

template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search(const dynamic_tree<D>& trees, const Query& query, const Apply& apply) {
    search_statistics seen;
    bool stopped = false;
    for (const tree<D>* one : trees.trees()) {
        if (stopped) break;
        seen += search(*one, query, [&](std::uint32_t id) {
            return stopped = id != detail::no_primitive && detail::asks_to_stop(apply, id);
        });
    }
    return seen;
}

template <std::size_t D, tree_query<D> Query, class Apply>
search_statistics search_broad(const dynamic_tree<D>& trees, const Query& query,
                               const Apply& apply) {
    search_statistics seen;
    bool stopped = false;
    for (const tree<D>* one : trees.trees()) {
        if (stopped) break;
        seen += search_broad(*one, query, [&](std::span<const std::uint32_t> block) {
            std::array<std::uint32_t, 8> ids;
            const auto last = std::copy_if(block.begin(), block.end(), ids.begin(),
                                           [](auto id) { return id != detail::no_primitive; });
            const auto count = static_cast<std::size_t>(last - ids.begin());
            return stopped =
                       count != 0 && detail::asks_to_stop(
                                         apply, std::span<const std::uint32_t>(ids.data(), count));
        });
    }
    return seen;
}

// Pairs.

/// A side of a search for pairs: one tree, or those of a dynamic tree; as they are, or moved:
/// `search<State>(tree_parts{trees, map}, other, apply)`.
///
/// \pre    the tree outlives this and every search that takes it, and is not updated meanwhile
/// \throws std::invalid_argument when an entry of `by` is NaN or infinite
template <std::size_t D>
class tree_parts {
  public:
    static constexpr std::size_t dimensions = D;

    tree_parts(const dynamic_tree<D>& trees, const transform<D>& by = {}) {  // NOLINT: implicit
        for (const tree<D>* one : trees.trees()) parts_.emplace_back(*one, by);
    }
    tree_parts(const tree<D>& one) : parts_{one} {}         // NOLINT: implicit
    tree_parts(const transformed<D>& one) : parts_{one} {}  // NOLINT: implicit

    [[nodiscard]] std::span<const transformed<D>> parts() const { return parts_; }

  private:
    std::vector<transformed<D>> parts_;
};

namespace detail {

template <class T>
inline constexpr bool is_of_parts = false;
template <std::size_t D>
inline constexpr bool is_of_parts<dynamic_tree<D>> = true;
template <std::size_t D>
inline constexpr bool is_of_parts<tree_parts<D>> = true;

/// What the searches for pairs below take, beside those of two trees.
template <class A, class B>
concept with_parts = (is_of_parts<A> && (is_of_parts<B> || is_placed_tree<B>)) ||
                     (is_placed_tree<A> && is_of_parts<B>);

/// The searches of several trees as one, their chunks one after the other. `visit` gets blocks
/// with the primitives [N] that the places of each side stand for.
template <std::size_t D>
class joined_search {
  public:
    explicit joined_search(const dynamic_tree<D>& trees) {
        const std::vector<const tree<D>*> parts = trees.trees();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            add(self_search<D>(*parts[i]), *parts[i], *parts[i]);
            for (std::size_t j = i + 1; j < parts.size(); ++j)
                add(pair_search<D>(*parts[i], *parts[j]), *parts[i], *parts[j]);
        }
    }
    joined_search(const tree_parts<D>& a, const tree_parts<D>& b) {
        for (const transformed<D>& x : a.parts())
            for (const transformed<D>& y : b.parts())
                add(pair_search<D>(x, y), x.original(), y.original());
    }

    [[nodiscard]] std::size_t chunks() const { return chunks_; }

    template <class Visit>
    search_statistics visit(std::size_t chunk, const Visit& visit) const {
        const auto above =
            std::upper_bound(pieces_.begin(), pieces_.end(), chunk,
                             [](std::size_t c, const piece& p) { return c < p.first_chunk; });
        const piece& at = *(above - 1);
        const auto on_block = [&](const candidate_block& block) {
            return visit(block, at.ids_a, at.ids_b);
        };
        return std::visit(
            [&](const auto& search) { return search.visit(chunk - at.first_chunk, on_block); },
            at.search);
    }

  private:
    struct piece {
        std::size_t first_chunk;
        std::variant<self_search<D>, pair_search<D>> search;
        const std::uint32_t* ids_a;
        const std::uint32_t* ids_b;
    };

    template <class Search>
    void add(Search search, const tree<D>& a, const tree<D>& b) {
        const std::size_t count = search.chunks();
        if (count == 0) return;
        pieces_.push_back({chunks_, std::move(search), a.ids().data(), b.ids().data()});
        chunks_ += count;
    }

    std::size_t chunks_ = 0;
    std::vector<piece> pieces_;
};

/// Calls `apply(a, b)` for the pairs of a block, until it is true.
inline constexpr auto any_of_block = [](const candidate_block& block, const std::uint32_t* ids_a,
                                        const std::uint32_t* ids_b, const auto& apply) {
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        const std::uint32_t a = ids_a[block.first[i]], b = ids_b[block.second[i]];
        if (a != no_primitive && b != no_primitive && apply(a, b)) return true;
    }
    return false;
};

template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> pair_states(const joined_search<D>& search, const Apply& apply) {
    return search_states<State>(
        search, [&](State& state, const candidate_block& block, const std::uint32_t* ids_a,
                    const std::uint32_t* ids_b) {
            return any_of_block(block, ids_a, ids_b, [&](std::uint32_t a, std::uint32_t b) {
                return asks_to_stop(apply, state, a, b);
            });
        });
}

/// Whether `accept(a, b)` for some pair: the tests stop on all threads once one is known.
template <std::size_t D, class Accept>
[[nodiscard]] bool any_pair(const joined_search<D>& search, const Accept& accept) {
    std::atomic<bool> found{false};
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        if (found.load(std::memory_order_relaxed)) return;
        search.visit(chunk, [&](const candidate_block& block, const std::uint32_t* ids_a,
                                const std::uint32_t* ids_b) {
            if (found.load(std::memory_order_relaxed)) return false;
            if (any_of_block(block, ids_a, ids_b, accept))
                found.store(true, std::memory_order_relaxed);
            return !found.load(std::memory_order_relaxed);
        });
    });
    return found.load();
}

template <std::size_t D, class Accept>
[[nodiscard]] std::vector<id_pair> all_pairs(const joined_search<D>& search, bool ordered,
                                             const Accept& accept) {
    using pairs = std::vector<id_pair>;
    pairs all =
        joined(pair_states<pairs>(search, [&](pairs& found, std::uint32_t a, std::uint32_t b) {
            if (ordered && b < a) std::swap(a, b);
            if (accept(a, b)) found.emplace_back(a, b);
        }));
    std::sort(all.begin(), all.end());
    return all;
}

inline constexpr auto every_pair = [](std::uint32_t, std::uint32_t) { return true; };

}  // namespace detail

template <class State, std::size_t D, class Apply>
[[nodiscard]] std::vector<State> search_self(const dynamic_tree<D>& trees, const Apply& apply) {
    return detail::pair_states<State>(detail::joined_search<D>(trees), apply);
}
template <std::size_t D, class Accept>
[[nodiscard]] bool search_self_any(const dynamic_tree<D>& trees, const Accept& accept) {
    return detail::any_pair(detail::joined_search<D>(trees), accept);
}
template <std::size_t D, class Accept>
[[nodiscard]] std::vector<id_pair> search_self_all(const dynamic_tree<D>& trees,
                                                   const Accept& accept) {
    return detail::all_pairs(detail::joined_search<D>(trees), true, accept);
}
template <std::size_t D>
[[nodiscard]] std::vector<id_pair> search_self_all(const dynamic_tree<D>& trees) {
    return search_self_all(trees, detail::every_pair);
}

template <class State, class A, class B, class Apply>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<State> search(const A& a, const B& b, const Apply& apply) {
    return detail::pair_states<State>(detail::joined_search<A::dimensions>(a, b), apply);
}
template <class A, class B, class Accept>
requires detail::with_parts<A, B>
[[nodiscard]] bool search_any(const A& a, const B& b, const Accept& accept) {
    return detail::any_pair(detail::joined_search<A::dimensions>(a, b), accept);
}
template <class A, class B, class Accept>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b, const Accept& accept) {
    return detail::all_pairs(detail::joined_search<A::dimensions>(a, b), false, accept);
}
template <class A, class B>
requires detail::with_parts<A, B>
[[nodiscard]] std::vector<id_pair> search_all(const A& a, const B& b) {
    return search_all(a, b, detail::every_pair);
}

}  // namespace treeform
