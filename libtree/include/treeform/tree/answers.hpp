#pragma once
/// \file
/// What searches return: candidate pairs, neighbors, and counts of their work.

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

/// A block of candidate pairs: `first[i]` and `second[i]`, as places in leaf order.
///
/// `tree.ids()[place]` is the primitive. Places that are near each other in a block are near each
/// other in memory, if you keep your data in leaf order. In a search of two trees, `first` are
/// places of the first and `second` of the second. In a search of one tree, `first[i] < second[i]`.
struct candidate_block {
    std::span<const std::uint32_t> first;   ///< [up to `max_candidates`]
    std::span<const std::uint32_t> second;  ///< [same]
};
inline constexpr std::size_t max_candidates = 1024;

/// Two primitives, by their positions in the ranges that the trees were built over.
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

namespace detail {

/// The squared distance of an answer: the answer itself when it is a number, else its member
/// `squared_distance`.
template <class Answer>
[[nodiscard]] constexpr double squared_distance_of(const Answer& answer) {
    if constexpr (std::is_arithmetic_v<Answer>)
        return static_cast<double>(answer);
    else
        return static_cast<double>(answer.squared_distance);
}

}  // namespace detail

/// A primitive near a query, and what the caller's function returned for it; of two trees, the
/// pair of a primitive of each (`id_pair`).
template <class Answer = double, class Id = std::uint32_t>
struct neighbor {
    Id id;
    Answer answer;

    [[nodiscard]] constexpr double squared_distance() const {
        return detail::squared_distance_of(answer);
    }
    friend bool operator==(const neighbor&, const neighbor&) = default;
    /// Whether `a` comes before `b` in answers: by distance, then by id.
    friend constexpr bool nearer(const neighbor& a, const neighbor& b) {
        const double of_a = a.squared_distance(), of_b = b.squared_distance();
        return of_a != of_b ? of_a < of_b : a.id < b.id;
    }
};

/// A list of answers for each of Q queries, all in one array.
template <class Answer>
struct answer_lists {
    std::vector<std::size_t> begin;  ///< [Q + 1] where each list starts, and the end
    std::vector<Answer> answers;

    [[nodiscard]] std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
    [[nodiscard]] std::span<const Answer> operator[](std::size_t query) const {
        return std::span(answers).subspan(begin[query], begin[query + 1] - begin[query]);
    }
};

}  // namespace treeform
