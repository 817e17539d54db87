#pragma once
/// \file
/// Results of searches: candidate pairs, neighbors, and counts of the work.

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace treeform {

/// A block of candidate pairs: `first[i]` and `second[i]`, as positions in leaf order.
///
/// `tree.ids()[position]` is the primitive. If you store your data in leaf order, the data of a
/// block are near each other in memory. In a search of two trees, `first` has positions in the
/// first tree, and `second` in the second. In a search of one tree, `first[i] < second[i]`.
struct candidate_block {
    std::span<const std::uint32_t> first;   ///< [up to `max_candidates`]
    std::span<const std::uint32_t> second;  ///< [as many]
};
inline constexpr std::size_t max_candidates = 1024;

/// Two primitives, by their positions in the ranges that the trees were built over.
using id_pair = std::pair<std::uint32_t, std::uint32_t>;

/// Counts of the work of a search. Sums over the chunks of a search do not depend on the number of
/// threads, unless the search was stopped.
struct search_statistics {
    std::uint64_t nodes = 0;      ///< nodes opened, or pairs of nodes
    std::uint64_t box_tests = 0;  ///< tests of one box against the eight boxes of a node
    /// primitives whose boxes overlap the query, or pairs of primitives
    std::uint64_t candidates = 0;

    search_statistics& operator+=(const search_statistics& other) {
        nodes += other.nodes;
        box_tests += other.box_tests;
        candidates += other.candidates;
        return *this;
    }
    friend bool operator==(const search_statistics&, const search_statistics&) = default;
};

namespace detail {

/// The squared distance of an answer: the answer itself if it is a number, else its member
/// `squared_distance`.
template <class Answer>
[[nodiscard]] constexpr double squared_distance_of(const Answer& answer) {
    if constexpr (std::is_arithmetic_v<Answer>)
        return static_cast<double>(answer);
    else
        return static_cast<double>(answer.squared_distance);
}

}  // namespace detail

/// A primitive near a query, and the value that the caller's function returned for it. In a search
/// of two trees, `id` is a pair of primitives (`id_pair`).
template <class Answer = double, class Id = std::uint32_t>
struct neighbor {
    Id id;
    Answer answer;

    [[nodiscard]] constexpr double squared_distance() const {
        return detail::squared_distance_of(answer);
    }
    friend bool operator==(const neighbor&, const neighbor&) = default;
    /// The order of answers: by distance, then by id.
    friend constexpr bool nearer(const neighbor& a, const neighbor& b) {
        const double of_a = a.squared_distance(), of_b = b.squared_distance();
        return of_a != of_b ? of_a < of_b : a.id < b.id;
    }
};

/// Lists of answers for Q queries, in one array.
template <class Answer>
struct answer_lists {
    std::vector<std::size_t> begin;  ///< [Q + 1] list q is answers [begin[q], begin[q + 1])
    std::vector<Answer> answers;

    [[nodiscard]] std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
    /// The list of a query, as a view into this object.
    [[nodiscard]] std::span<const Answer> operator[](std::size_t query) const& {
        return std::span(answers).subspan(begin[query], begin[query + 1] - begin[query]);
    }
    std::span<const Answer> operator[](std::size_t query) && = delete;  // it would dangle
};

}  // namespace treeform
