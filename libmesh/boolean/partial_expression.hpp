#pragma once
/// \file
/// What an expression comes to while of some operands it is not known whether a point is in them.

#include <treeform/mesh/boolean.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The numbers from `low` to `high` that a winding number can be.
struct winding_range {
    std::int64_t low = 0;
    std::int64_t high = 0;

    /// Beyond every winding number, and as many of them can be added up as there are faces.
    static constexpr std::int64_t unlimited = std::int64_t{1} << 31;
    static constexpr winding_range unknown() { return {-unlimited, unlimited}; }
    static constexpr winding_range only(std::int64_t winding) { return {winding, winding}; }

    friend bool operator==(const winding_range&, const winding_range&) = default;
};

/// Whether a place is inside that a surface winds around so often.
[[nodiscard]] bool is_inside(fill_rule rule, std::int64_t winding);

/// An expression over the winding numbers of operands at one place, of each of which a range is
/// known; at first, all are 0. To move to another place, say what changes.
///
/// Formulas are kept as trees whose nodes count their true and false members: a change costs the
/// way up to where nothing changes any more, two nodes in a union of any number of operands.
class partial_expression {
  public:
    partial_expression(const boolean_expression& expression, fill_rule rule);

    /// Adds to both ends of the range of an operand.
    void add(std::uint32_t operand, const winding_range& change);

    /// Whether the place is in the solid; none where that depends on what is not known.
    [[nodiscard]] std::optional<bool> value() const;

  private:
    enum class kind : std::uint8_t { any, all, odd };
    enum class truth : std::uint8_t { is_false, is_true, unknown };
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct node {
        kind of = kind::any;
        bool is_negated = false;  ///< its parent takes the opposite
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
    std::vector<std::size_t> leaf_begin_;  ///< [K + 1] where those of an operand begin
    std::vector<std::uint32_t> leaves_{};  ///< nodes, operand by operand
};

}  // namespace treeform::detail::boolean
