#pragma once
/// \file
/// Words for enumerators, and other small arguments.

#include "arrays.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace binding {

/// The words of an enumeration, in the order of its values from 0.
template <std::size_t N>
using words = std::array<const char*, N>;

inline constexpr words<2> precision_words{"float32", "float64"};
inline constexpr words<10> status_words{
    "ok",       "open_input",   "sheet",    "excessive_loss", "not_manifold", "not_certified",
    "vanished", "out_of_range", "no_place", "cancelled"};
inline constexpr words<3> fill_rule_words{"nonzero", "odd", "positive"};
inline constexpr words<2> identity_words{"by_coordinates", "by_index"};
inline constexpr words<5> standing_words{"separate", "touching", "penetrating",
                                         "closer_than_clearance", "clear"};
inline constexpr words<2> weld_rule_words{"first", "chain"};
inline constexpr words<5> weld_keep_words{"first", "last", "mean", "lowest", "highest"};
inline constexpr words<3> weld_order_words{"given", "lowest", "highest"};
inline constexpr words<2> feature_words{"plane", "axis"};

/// The enumerator of `word`.
///
/// \throws std::invalid_argument naming the words there are
template <class Enum, std::size_t N>
Enum choice(const char* argument, const words<N>& all, std::string_view word) {
    std::string there;
    for (std::size_t i = 0; i < N; ++i) {
        if (word == all[i]) return static_cast<Enum>(i);
        there += (i == 0 ? "" : ", ") + std::string(all[i]);
    }
    throw std::invalid_argument(std::string(argument) + ": \"" + std::string(word) +
                                "\" is none of " + there);
}

template <class Enum, std::size_t N>
const char* word_of(const words<N>& all, Enum value) {
    return all[static_cast<std::size_t>(value)];
}

inline tf::precision precision_of(std::string_view word) {
    return choice<tf::precision>("precision", precision_words, word);
}
inline tf::vertex_identity identity_of(std::string_view word) {
    return choice<tf::vertex_identity>("vertices", identity_words, word);
}

/// A point of the three numbers of an array.
inline tf::point3 point_of(const array_of<double>& numbers) {
    if (numbers.size() != 3) throw std::invalid_argument("treeform: not three numbers");
    return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

/// The map of a matrix [4][4]; its last row has been looked at.
inline tf::transform<3> transform_of(const double* matrix) {
    tf::transform<3> map;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 4; ++j) map.rows[k][j] = matrix[k * 4 + j];
    return map;
}
inline tf::transform<3> transform_of(const array_of<double>& matrix) {
    if (matrix.size() != 16) throw std::invalid_argument("treeform: a matrix has 4 rows of 4");
    return transform_of(matrix.data());
}

/// The matrix [4][4] of a map.
inline py::array_t<double> as_array(const tf::transform<3>& map) {
    py::array_t<double> made({4, 4});
    double* to = made.mutable_data();
    for (const auto& row : map.rows)
        for (const double entry : row) *to++ = entry;
    for (const double entry : {0.0, 0.0, 0.0, 1.0}) *to++ = entry;
    return made;
}

}  // namespace binding
