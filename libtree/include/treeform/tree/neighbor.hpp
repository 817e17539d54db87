#pragma once
/// \file
/// The answers of nearness searches.

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace treeform {

/// The squared distance that an answer stands for: itself when it is a number, else its member.
template <class Answer>
[[nodiscard]] constexpr double squared_distance_of(const Answer& answer) {
    if constexpr (std::is_arithmetic_v<Answer>)
        return static_cast<double>(answer);
    else
        return static_cast<double>(answer.squared_distance);
}

/// A primitive near a query, and what the caller's function said about it.
template <class Answer = double>
struct neighbor {
    std::uint32_t id;
    Answer answer;

    [[nodiscard]] constexpr double squared_distance() const { return squared_distance_of(answer); }
    friend bool operator==(const neighbor&, const neighbor&) = default;
};

/// The order of answers: by distance, then by number.
template <class Neighbor>
[[nodiscard]] constexpr bool nearer(const Neighbor& a, const Neighbor& b) {
    const double of_a = a.squared_distance();
    const double of_b = b.squared_distance();
    return of_a != of_b ? of_a < of_b : a.id < b.id;
}

/// A list of answers for each of Q queries, in one array.
template <class Neighbor>
struct neighbor_lists {
    std::vector<std::size_t> begin;  ///< [Q + 1] where each list starts, and the end
    std::vector<Neighbor> neighbors;

    [[nodiscard]] std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
    [[nodiscard]] std::span<const Neighbor> operator[](std::size_t query) const {
        return std::span(neighbors).subspan(begin[query], begin[query + 1] - begin[query]);
    }
};

}  // namespace treeform
