#pragma once
/// \file
/// Whether points that are near each other may become one: by values that each has.

#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// What the values of two points must have in common. A value is the ascending key of a
/// `vertex_values`; the values of a point are consecutive.
class TREEFORM_API agreement {
  public:
    struct condition {
        bool whole = false;      ///< the key is of a whole number of 64 bits
        double tolerance = 0.0;  ///< as in `weld_condition`
    };
    agreement() = default;
    explicit agreement(std::vector<condition> conditions);

    /// Values that a point has.
    [[nodiscard]] std::size_t size() const { return conditions_.size(); }
    /// Whether points that agree with one point agree with each other.
    [[nodiscard]] bool is_transitive() const { return transitive_; }

    /// \pre `size()` values at both places
    [[nodiscard]] bool holds(const std::uint64_t* a, const std::uint64_t* b) const;
    /// Whether all values are the same.
    [[nodiscard]] bool same(const std::uint64_t* a, const std::uint64_t* b) const;
    /// Equal for points that agree, and mostly different for others.
    [[nodiscard]] std::uint64_t salt(const std::uint64_t* values) const;
    /// Equal numbers for rows whose values that have to be equal are.
    [[nodiscard]] std::vector<std::uint32_t> labels(std::span<const std::uint64_t> rows) const;

  private:
    [[nodiscard]] bool equal_before(const std::uint64_t* a, const std::uint64_t* b) const;

    std::vector<condition> conditions_{};
    bool transitive_ = true;
};

}  // namespace treeform::detail::weld
