#pragma once
/// \file
/// Values of options: numbers, distances, sizes. Locale-free; what is left over is an error.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// A length in the unit of the file, or a share of the diagonal of its box.
struct distance {
    std::string given = "0";  ///< as typed
    double value = 0.0;       ///< the length, or the share: 0.0001 for "0.01%"
    bool relative = false;
    /// The length for a box with this diagonal.
    [[nodiscard]] double used(double diagonal) const { return relative ? value * diagonal : value; }
};

/// "union, symmetric-difference, split"
[[nodiscard]] std::string listed(std::span<const char* const> words);

/// All of them: \throws failure (bad_usage) naming `option`, the text and what was expected.
[[nodiscard]] double parse_number(std::string_view option, std::string_view text);
[[nodiscard]] std::vector<double> parse_numbers(std::string_view option, std::string_view text,
                                                std::size_t count);
/// "1,0,-2.5"
[[nodiscard]] tf::point3 parse_point(std::string_view option, std::string_view text);
/// The same, not all 0.
[[nodiscard]] tf::point3 parse_direction(std::string_view option, std::string_view text);
/// Which of `words` it is.
[[nodiscard]] std::size_t parse_choice(std::string_view option, std::string_view text,
                                       std::span<const char* const> words);
[[nodiscard]] std::uint64_t parse_count(std::string_view option, std::string_view text);
/// Finite, not negative.
[[nodiscard]] distance parse_distance(std::string_view option, std::string_view text);
/// Finite, not negative, in cubic units.
[[nodiscard]] double parse_volume(std::string_view option, std::string_view text);
/// "5%" or "0.05", from 0 to 1.
[[nodiscard]] double parse_share(std::string_view option, std::string_view text);
/// Bytes: "512M", "4G", "4GiB", "1.5G", "1000000"; K, M, G and T are powers of 1024.
[[nodiscard]] std::uint64_t parse_size(std::string_view option, std::string_view text);
/// Seconds, greater than 0.
[[nodiscard]] double parse_seconds(std::string_view option, std::string_view text);

}  // namespace tools
