#pragma once
/// \file
/// What the searches for pairs hand out, and what they count.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace treeform {

/// A block of candidate pairs: primitives `first[i]` and `second[i]` as places in leaf order, so
/// that neighbours in a block are neighbours in memory for data kept in that order;
/// `tree.ids()[place]` is the primitive. In a search of two trees, `first` are places of the first
/// and `second` of the second; in a search of a tree by itself `first[i] < second[i]`.
struct candidate_block {
    std::span<const std::uint32_t> first;   ///< [up to `max_candidates`]
    std::span<const std::uint32_t> second;  ///< [same]
};
inline constexpr std::size_t max_candidates = 1024;

/// Two primitives, by their places in the ranges the trees were built over.
using id_pair = std::pair<std::uint32_t, std::uint32_t>;

/// What a search looked at; the rest of the trees it skipped. Sums over the chunks of a search do
/// not depend on the number of threads, unless the search was stopped.
struct search_statistics {
    std::uint64_t nodes = 0;       ///< nodes opened, or pairs of them
    std::uint64_t box_tests = 0;   ///< of a box against the eight of a node
    std::uint64_t candidates = 0;  ///< primitives whose boxes overlap the query, or pairs of them

    search_statistics& operator+=(const search_statistics& other) {
        nodes += other.nodes;
        box_tests += other.box_tests;
        candidates += other.candidates;
        return *this;
    }
    friend bool operator==(const search_statistics&, const search_statistics&) = default;
};

}  // namespace treeform
