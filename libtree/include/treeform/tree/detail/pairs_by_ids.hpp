#pragma once
/// \file
/// Searches for pairs of primitives in chunks: of two `tree`s directly, of other trees part by
/// part.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/search_chunks.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace treeform::detail {

/// A search of two trees, or of one tree with itself. `visit(block, ids_a, ids_b)` also gets the
/// primitives [N] at the places of each side.
template <class Search>
class pairs_of_tree {
  public:
    static constexpr bool has_empty_slots = false;

    pairs_of_tree(Search search, const std::uint32_t* ids_a, const std::uint32_t* ids_b)
        : search_(std::move(search)), ids_a_(ids_a), ids_b_(ids_b) {}

    [[nodiscard]] std::size_t chunks() const { return search_.chunks(); }

    template <class Visit>
    search_statistics visit(std::size_t chunk, const Visit& visit) const {
        return search_.visit(
            chunk, [&](const candidate_block& block) { return visit(block, ids_a_, ids_b_); });
    }

  private:
    Search search_;
    const std::uint32_t* ids_a_;
    const std::uint32_t* ids_b_;
};

/// The searches of several pairs of trees as one, their chunks one after the other.
template <class... Searches>
class pairs_of_parts {
  public:
    static constexpr bool has_empty_slots = true;

    template <class Search>
    void add(Search search, const std::uint32_t* ids_a, const std::uint32_t* ids_b) {
        const std::size_t count = search.chunks();
        if (count == 0) return;
        pieces_.push_back({chunks_, pairs_of_tree<Search>(std::move(search), ids_a, ids_b)});
        chunks_ += count;
    }

    [[nodiscard]] std::size_t chunks() const { return chunks_; }

    template <class Visit>
    search_statistics visit(std::size_t chunk, const Visit& visit) const {
        const auto above =
            std::upper_bound(pieces_.begin(), pieces_.end(), chunk,
                             [](std::size_t c, const piece& p) { return c < p.first_chunk; });
        const piece& at = *(above - 1);
        return std::visit(
            [&](const auto& pairs) { return pairs.visit(chunk - at.first_chunk, visit); },
            at.pairs);
    }

  private:
    struct piece {
        std::size_t first_chunk;
        std::variant<pairs_of_tree<Searches>...> pairs;
    };

    std::size_t chunks_ = 0;
    std::vector<piece> pieces_;
};

/// Calls `apply(a, b)` for the pairs of a block until it returns true; returns whether it did.
template <bool has_empty_slots, class Apply>
bool any_of_block(const candidate_block& block, const std::uint32_t* ids_a,
                  const std::uint32_t* ids_b, const Apply& apply) {
    for (std::size_t i = 0; i < block.first.size(); ++i) {
        const std::uint32_t a = ids_a[block.first[i]], b = ids_b[block.second[i]];
        if constexpr (has_empty_slots)
            if (a == no_primitive || b == no_primitive) continue;
        if (apply(a, b)) return true;
    }
    return false;
}

/// The states of `apply(state, a, b)` for all pairs.
template <class State, class Pairs, class Apply>
[[nodiscard]] std::vector<State> pair_states(const Pairs& pairs, const Apply& apply) {
    return search_states<State>(pairs, [&](State& state, const candidate_block& block,
                                           const std::uint32_t* ids_a, const std::uint32_t* ids_b) {
        return any_of_block<Pairs::has_empty_slots>(
            block, ids_a, ids_b,
            [&](std::uint32_t a, std::uint32_t b) { return asks_to_stop(apply, state, a, b); });
    });
}

/// The pairs for which `accept(a, b)` is true, ascending; with a < b if `unordered`.
template <bool unordered, class Pairs, class Accept>
[[nodiscard]] std::vector<id_pair> all_pairs(const Pairs& pairs, const Accept& accept) {
    using found_pairs = std::vector<id_pair>;
    found_pairs all = joined(
        pair_states<found_pairs>(pairs, [&](found_pairs& found, std::uint32_t a, std::uint32_t b) {
            if (unordered && b < a) std::swap(a, b);
            if (accept(a, b)) found.emplace_back(a, b);
        }));
    std::sort(all.begin(), all.end());
    return all;
}

inline constexpr auto every_pair = [](std::uint32_t, std::uint32_t) { return true; };

/// Whether `search_parts(x, y, accepted)` is true for some pair of parts. `accepted` calls `accept`
/// for pairs of primitives. Stops at the first such pair.
template <class Accept, class SearchParts>
[[nodiscard]] bool any_of_parts(const std::vector<id_pair>& parts, const Accept& accept,
                                const SearchParts& search_parts) {
    std::atomic<bool> found{false};
    const auto accepted = [&](std::uint32_t a, std::uint32_t b) {
        if (found.load(std::memory_order_relaxed)) return true;
        return a != no_primitive && b != no_primitive && static_cast<bool>(accept(a, b));
    };
    for_chunks(parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
        if (found.load(std::memory_order_relaxed)) return;
        if (search_parts(parts[i].first, parts[i].second, accepted))
            found.store(true, std::memory_order_relaxed);
    });
    return found.load();
}

/// Calls `add(x, y)` for the pairs of parts in order, after `prepare(x, y)` for all pairs in
/// parallel, so that parts that are built on demand are built in parallel.
template <class Prepare, class Add>
void for_parts(const std::vector<id_pair>& parts, const Prepare& prepare, const Add& add) {
    for_chunks(parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
        prepare(parts[i].first, parts[i].second);
    });
    for (const auto& [x, y] : parts) add(x, y);
}

}  // namespace treeform::detail
