#pragma once
/// \file
/// A vertex property as numbers that can be compared exactly.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform::detail::weld {

/// Whether values with these ascending keys agree, as `vertex_values::agree` says.
[[nodiscard]] bool keys_agree(bool whole, std::uint64_t a, std::uint64_t b, double tolerance);

class vertex_values {
  public:
    /// The column `name` of "vertex", or coordinates for "x", "y" and "z".
    ///
    /// \throws std::invalid_argument when it is not there or is a list
    vertex_values(points_view points, const attributes& properties, const std::string& name);

    [[nodiscard]] bool less(std::size_t i, std::size_t j) const {
        return whole_.size() > 0 ? whole_[i] < whole_[j] : number_[i] < number_[j];
    }
    [[nodiscard]] bool is_nan(std::size_t i) const {
        return whole_.size() == 0 && number_[i] != number_[i];
    }
    /// Less where the value is less, equal where it is equal (-0 to +0); NaN comes last.
    [[nodiscard]] std::uint64_t ascending_key(std::size_t i) const;
    /// Less where the value is greater; otherwise the same.
    [[nodiscard]] std::uint64_t descending_key(std::size_t i) const {
        return is_nan(i) ? ascending_key(i) : ~ascending_key(i);
    }
    /// Whether the values differ by at most `tolerance`, finite and not negative; NaN differs from
    /// all but NaN.
    [[nodiscard]] bool agree(std::size_t i, std::size_t j, double tolerance) const;

    /// Whether they are whole numbers of 64 bits.
    [[nodiscard]] bool is_whole() const { return whole_.size() > 0; }

    /// The values in one or two columns of doubles, which are equal where the values are.
    [[nodiscard]] std::vector<buffer<double>> take_columns() &&;

  private:
    // One of the two is empty.
    buffer<double> number_;
    /// Numbers of 64 bits, which doubles do not hold; ordered and as far apart as the values.
    buffer<std::uint64_t> whole_;
};

}  // namespace treeform::detail::weld
