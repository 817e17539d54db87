#pragma once
/// \file
/// Formulas of set operations.

#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

/// A formula over operands a, b, c, ..., z (then aa, ab, ...): `+` or `|` union, `*` or `&`
/// intersection, `-` difference, `^` exclusive or, and brackets. `*` and `&` bind tighter than the
/// others, which go from left to right. Blanks and the case of letters do not matter.
class TREEFORM_API boolean_expression {
  public:
    /// \throws std::invalid_argument naming the position, from 1, of what is not a formula or of an
    ///         operand beyond `operand_count`
    /// \cost   O(characters) time, however deep the brackets
    boolean_expression(std::string_view text, std::size_t operand_count);
    /// The same with names in place of letters, "body-(bolt_1+'left bolt')": words of letters,
    /// digits, underscores and dots, or anything in quotes. The first operand of a name is meant.
    boolean_expression(std::string_view text, std::span<const std::string> names);
    /// Those of a formula with names, each once, in the order in which they come first.
    [[nodiscard]] static std::vector<std::string> names_in(std::string_view text);

    /// What is in any operand. Without operands, this and the formulas below are empty.
    [[nodiscard]] static boolean_expression union_of(std::size_t operand_count);
    /// What is in all operands.
    [[nodiscard]] static boolean_expression intersection_of(std::size_t operand_count);
    /// The first operand without all others.
    [[nodiscard]] static boolean_expression difference_of(std::size_t operand_count);
    /// What is in an odd number of operands.
    [[nodiscard]] static boolean_expression xor_of(std::size_t operand_count);

    [[nodiscard]] std::size_t operand_count() const { return operand_count_; }

    /// Whether a point belongs to the result when it is in these operands and in no others.
    /// \pre `in_operand` has a value for each operand
    [[nodiscard]] bool operator()(std::span<const bool> in_operand) const;

    /// True when no point outside this operand can belong to the result: in `a-b` for a, in `a+b`
    /// for neither. Found in one pass, so it may be false for long formulas of which it is true.
    [[nodiscard]] bool needs(std::size_t operand) const;

    /// The formula, operations behind what they take: operands as numbers from 0, and these.
    enum : std::int32_t { add = -1, intersect = -2, minus = -3, exclude = -4 };
    [[nodiscard]] std::span<const std::int32_t> postfix() const { return postfix_; }

  private:
    boolean_expression(std::size_t operand_count, std::int32_t operation);

    std::size_t operand_count_ = 0;
    std::vector<std::int32_t> postfix_;
};

}  // namespace treeform
