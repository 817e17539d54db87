#pragma once
/// \file
/// The values of a vertex property, for exact comparisons.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::weld {

/// \throws std::invalid_argument of `weld`, always
[[noreturn]] void refuse(const std::string& why);

/// \throws std::invalid_argument for options that others make meaningless
void check_choices(const char* function, weld_keep keep, bool has_keep_by, bool has_order,
                   bool highest_first);

/// The columns that `options.keep_by` and `options.order_by` name.
/// \throws weld_property_error when the name matches no column, several columns, or a list column
[[nodiscard]] std::string column_to_keep_by(const attributes& properties,
                                            const weld_options& options);
[[nodiscard]] std::string column_to_order_by(const attributes& properties,
                                             const weld_options& options);

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

/// The conditions that the values of two points must fulfill to be merged. A value is the ascending
/// key of a `vertex_values`; the values of a point are contiguous.
class TREEFORM_API agreement {
  public:
    struct condition {
        bool whole = false;      ///< the key is that of a 64-bit integer
        double tolerance = 0.0;  ///< as in `weld_condition`
    };
    agreement() = default;
    explicit agreement(std::vector<condition> conditions);

    /// Number of values of a point.
    [[nodiscard]] std::size_t size() const { return conditions_.size(); }
    /// Whether agreement is transitive: true if all tolerances are 0.
    [[nodiscard]] bool is_transitive() const { return transitive_; }

    /// Whether the two points agree. \pre `a` and `b` point to `size()` values
    [[nodiscard]] bool holds(const std::uint64_t* a, const std::uint64_t* b) const;
    /// Whether all values are the same.
    [[nodiscard]] bool same(const std::uint64_t* a, const std::uint64_t* b) const;
    /// A hash: equal for points that agree, and usually different for others.
    [[nodiscard]] std::uint64_t salt(const std::uint64_t* values) const;
    /// One label for each row of values; equal if all values with a tolerance of 0 are equal.
    [[nodiscard]] std::vector<std::uint32_t> labels(std::span<const std::uint64_t> rows) const;

  private:
    [[nodiscard]] bool equal_before(const std::uint64_t* a, const std::uint64_t* b) const;

    std::vector<condition> conditions_{};
    bool transitive_ = true;
};

}  // namespace treeform::detail::weld
