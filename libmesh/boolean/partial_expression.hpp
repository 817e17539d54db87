#pragma once
/// \file
/// Evaluates an expression while the membership in some operands is unknown.

#include <treeform/mesh/boolean.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// A range of possible winding numbers, inclusive.
struct winding_range {
    std::int64_t low = 0;
    std::int64_t high = 0;

    /// Larger than every winding number; a sum of as many as there are faces does not overflow.
    static constexpr std::int64_t unlimited = std::int64_t{1} << 31;
    static constexpr winding_range unknown() { return {-unlimited, unlimited}; }
    static constexpr winding_range only(std::int64_t winding) { return {winding, winding}; }

    friend bool operator==(const winding_range&, const winding_range&) = default;
};

/// Whether a place with this winding number is inside.
[[nodiscard]] bool is_inside(fill_rule rule, std::int64_t winding);

/// An expression over ranges of the operands' winding numbers at one place; initially all are 0. To
/// move to another place, `add` the changes.
///
/// The formula is a tree whose nodes count their true and false members. An update stops at the
/// first node that does not change: it visits at most two nodes in a union of any number of
/// operands.
class partial_expression {
  public:
    partial_expression(const boolean_expression& expression, fill_rule rule);

    /// Adds `change` to both ends of the range of an operand.
    void add(std::uint32_t operand, const winding_range& change);

    /// Whether the place is in the solid; none if that depends on unknown winding numbers.
    [[nodiscard]] std::optional<bool> value() const;

  private:
    enum class kind : std::uint8_t { any, all, odd };
    enum class truth : std::uint8_t { is_false, is_true, unknown };
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct node {
        kind of = kind::any;
        bool is_negated = false;  ///< whether its parent uses the negated value
        std::uint32_t parent = none;
        std::uint32_t members = 0;
        std::uint32_t are_true = 0;
        std::uint32_t are_false = 0;
    };

    std::uint32_t combine(std::int32_t operation, std::uint32_t left, std::uint32_t right);
    void hang(std::uint32_t below, std::uint32_t above);
    void count(std::uint32_t at, truth before, truth now);
    [[nodiscard]] static truth truth_of(const node& n);
    [[nodiscard]] truth truth_of(const winding_range& range) const;

    fill_rule rule_;
    std::vector<node> nodes_{};
    std::uint32_t root_ = none;
    std::vector<winding_range> range_;     ///< [K]
    std::vector<std::size_t> leaf_begin_;  ///< [K + 1] begin of the leaves of each operand
    std::vector<std::uint32_t> leaves_{};  ///< nodes, operand by operand
};

}  // namespace treeform::detail::boolean
