#pragma once
/// \file
/// The values of a vertex property, for exact comparisons.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform::detail::weld {

/// Whether values with these ascending keys agree, as in `vertex_values::agree`.
[[nodiscard]] bool keys_agree(bool whole, std::uint64_t a, std::uint64_t b, double tolerance);

class vertex_values {
  public:
    /// Takes the values of the column `name` of "vertex", or coordinates for "x", "y" and "z".
    ///
    /// \throws std::invalid_argument when the column is missing or is a list
    vertex_values(points_view points, const attributes& properties, const std::string& name);

    [[nodiscard]] bool less(std::size_t i, std::size_t j) const {
        return whole_.size() > 0 ? whole_[i] < whole_[j] : number_[i] < number_[j];
    }
    [[nodiscard]] bool is_nan(std::size_t i) const {
        return whole_.size() == 0 && number_[i] != number_[i];
    }
    /// A key that is ordered like the values; equal for equal values (-0 equals +0). NaN is last.
    [[nodiscard]] std::uint64_t ascending_key(std::size_t i) const;
    /// A key that is ordered opposite to the values; otherwise like `ascending_key`.
    [[nodiscard]] std::uint64_t descending_key(std::size_t i) const {
        return is_nan(i) ? ascending_key(i) : ~ascending_key(i);
    }
    /// Whether the values differ by at most `tolerance`, which is finite and not negative. NaN
    /// agrees only with NaN.
    [[nodiscard]] bool agree(std::size_t i, std::size_t j, double tolerance) const;

    /// Whether the values are 64-bit integers.
    [[nodiscard]] bool is_whole() const { return whole_.size() > 0; }

    /// The values as one or two columns of doubles, which are equal if and only if the values are.
    [[nodiscard]] std::vector<buffer<double>> take_columns() &&;

  private:
    // One of the two is empty.
    buffer<double> number_;
    /// 64-bit integers, which doubles cannot represent, as unsigned keys with the same order and
    /// differences.
    buffer<std::uint64_t> whole_;
};

}  // namespace treeform::detail::weld
