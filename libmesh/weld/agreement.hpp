#pragma once
/// \file
/// Conditions on the values of points that decide whether near points may be merged.

#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

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
