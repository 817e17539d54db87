#pragma once
/// \file
/// Runs the chunks of a search for pairs in parallel.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/parallel.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform::detail {

/// Two nodes whose candidate pairs are searched for. Their levels are known to the owner.
struct node_pair {
    std::uint32_t a, b;
};

inline void lower(std::atomic<std::size_t>& value, std::size_t to) {
    std::size_t seen = value.load();
    while (to < seen && !value.compare_exchange_weak(seen, to)) {
    }
}

/// The value that `apply` returns, or false if it returns nothing.
template <class Apply, class... Args>
bool asks_to_stop(const Apply& apply, Args&&... args) {
    if constexpr (std::is_void_v<std::invoke_result_t<const Apply&, Args...>>) {
        apply(std::forward<Args>(args)...);
        return false;
    } else {
        return static_cast<bool>(apply(std::forward<Args>(args)...));
    }
}

/// Runs every chunk of `search` with its own state: calls `on_block(state, ...)` for each visited
/// block, and returns the states in order. If `on_block` returns true, the search stops, and that
/// chunk's state is the last.
template <class State, class Search, class OnBlock>
[[nodiscard]] std::vector<State> search_states(const Search& search, const OnBlock& on_block) {
    static_assert(!std::is_same_v<State, bool>, "a vector of bool shares bytes between threads");
    std::vector<State> states(search.chunks());
    std::atomic<std::size_t> last{states.size()};  // the first chunk that asked to stop
    for_chunks(states.size(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        State mine{};  // local: elements of `states` share cache lines
        search.visit(chunk, [&](const auto&... block) {
            if (chunk > last.load(std::memory_order_relaxed)) return false;
            if (!on_block(mine, block...)) return true;
            lower(last, chunk);
            return false;
        });
        states[chunk] = std::move(mine);
    });
    if (last.load() < states.size()) states.resize(last.load() + 1);
    return states;
}

/// Whether `on_block(block)` is true for some block; stops at the first such block.
template <class Search, class OnBlock>
[[nodiscard]] bool search_for_any(const Search& search, const OnBlock& on_block) {
    std::atomic<bool> found{false};
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        if (found.load(std::memory_order_relaxed)) return;
        search.visit(chunk, [&](const candidate_block& block) {
            if (found.load(std::memory_order_relaxed)) return false;
            if (on_block(block)) found.store(true, std::memory_order_relaxed);
            return !found.load(std::memory_order_relaxed);
        });
    });
    return found.load();
}

/// The concatenated vectors of all chunks.
template <class T>
[[nodiscard]] std::vector<T> joined(const std::vector<std::vector<T>>& parts) {
    std::size_t total = 0;
    for (const std::vector<T>& part : parts) total += part.size();
    std::vector<T> all;
    all.reserve(total);
    for (const std::vector<T>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace treeform::detail
