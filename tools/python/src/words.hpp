#pragma once
/// \file
/// Enumerators as strings, and other small arguments.

#include "arrays.hpp"

namespace binding {

/// The names of enumerators, in the order of their values from 0.
template <std::size_t N>
using words = std::array<const char*, N>;

/// The names of the enumerators of an enumeration, in `made/words.hpp`.
template <class Enum>
struct words_of;
template <class Enum>
concept has_words = requires {
    words_of<Enum>::all;
};

/// The enumerator with the name `word`.
///
/// \throws std::invalid_argument naming the valid words
template <class Enum, std::size_t N>
Enum choice(const char* argument, const words<N>& all, std::string_view word) {
    std::string there;
    for (std::size_t i = 0; i < N; ++i) {
        if (word == all[i]) return static_cast<Enum>(i);
        there += (i == 0 ? "" : ", ") + std::string(all[i]);
    }
    if (there.ends_with("highest")) there += " (the last two with keep_by=)";
    throw std::invalid_argument(std::string(argument) + ": expected one of " + there + ", not '" +
                                std::string(word) + "'");
}

template <has_words Enum>
const char* word_of(Enum value) {
    return words_of<Enum>::all[static_cast<std::size_t>(value)];
}

/// The three numbers of an array as a point.
inline tf::point3 point_of(const array_of<double>& numbers) {
    if (numbers.size() != 3) throw std::invalid_argument("treeform: expected three numbers");
    return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

/// The transform for a matrix [4][4], whose last row has been checked.
inline tf::transform<3> transform_of(const double* matrix) {
    tf::transform<3> map;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 4; ++j) map.rows[k][j] = matrix[k * 4 + j];
    return map;
}
inline tf::transform<3> transform_of(const array_of<double>& matrix) {
    if (matrix.size() != 16)
        throw std::invalid_argument("treeform: expected a matrix of shape (4, 4)");
    return transform_of(matrix.data());
}

/// The transforms for matrices [n][4][4].
inline std::vector<tf::transform<3>> transforms_of(const array_of<double>& matrices) {
    std::vector<tf::transform<3>> all(static_cast<std::size_t>(matrices.size()) / 16);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = transform_of(matrices.data() + i * 16);
    return all;
}

/// Writes the matrix [4][4] of a transform to `to`, and returns the position behind it.
inline double* put(const tf::transform<3>& map, double* to) {
    for (const auto& row : map.rows) to = std::ranges::copy(row, to).out;
    return std::ranges::copy(std::array{0.0, 0.0, 0.0, 1.0}, to).out;
}

/// The matrix [4][4] of a transform.
inline py::array_t<double> as_array(const tf::transform<3>& map) {
    py::array_t<double> made({4, 4});
    put(map, made.mutable_data());
    return made;
}

}  // namespace binding
