#pragma once
/// \file
/// Formulas over solids: which points a set operation keeps, given the operands they are in.

#include <treeform/tree/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace treeform {

/// A formula over operands a, b, c, ..., z (then aa, ab, ...): `+` or `|` union, `*` or `&`
/// intersection, `-` difference, `^` exclusive or, and brackets. `*` and `&` bind tighter than the
/// others, which go from left to right. Blanks and the case of letters do not matter.
class TREEFORM_API boolean_expression {
  public:
    /// \throws std::invalid_argument naming the position, from 1, of what cannot be read or of an
    ///         operand beyond `operand_count`
    /// \cost   O(characters) time, however deep the brackets
    boolean_expression(std::string_view text, std::size_t operand_count);

    /// What lies in any of them; of no operands nothing, as all below.
    [[nodiscard]] static boolean_expression union_of(std::size_t operand_count);
    [[nodiscard]] static boolean_expression intersection_of(std::size_t operand_count);
    /// The first without all others.
    [[nodiscard]] static boolean_expression difference_of(std::size_t operand_count);
    /// What lies in an odd number of them.
    [[nodiscard]] static boolean_expression xor_of(std::size_t operand_count);

    [[nodiscard]] std::size_t operand_count() const { return operand_count_; }

    /// Its value for points that are in these operands and in no others.
    /// \pre `in_operand` has a value for each operand
    [[nodiscard]] bool operator()(std::span<const bool> in_operand) const;

    /// Whether it is false for all points outside of that operand, whatever others they are in, as
    /// far as going through it once tells: of `a-b` for a, of `a+b` for none.
    [[nodiscard]] bool needs(std::size_t operand) const;

  private:
    boolean_expression(std::size_t operand_count, std::int32_t operation);

    std::size_t operand_count_ = 0;
    std::vector<std::int32_t> postfix_;  ///< operands as numbers from 0, operations below 0
};

}  // namespace treeform
