#include <libmesh/boolean/partial_expression.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace {

using tf::detail::boolean::partial_expression;
using tf::detail::boolean::winding_range;

constexpr std::uint32_t operand_count = 4;

std::string nested_formula(test::random& source, unsigned depth) {
    if (depth == 0 || source.below(4) == 0)
        return std::string(1, static_cast<char>('a' + source.below(operand_count)));
    const char operation = "+-*^"[source.below(4)];
    return "(" + nested_formula(source, depth - 1) + ")" + operation + "(" +
           nested_formula(source, depth - 1) + ")";
}

bool is_filled(tf::fill_rule rule, std::int64_t winding) {
    if (rule == tf::fill_rule::even_odd) return winding % 2 != 0;
    return rule == tf::fill_rule::positive ? winding > 0 : winding != 0;
}

/// What all winding numbers in the ranges agree on.
std::optional<bool> by_trying(const tf::boolean_expression& expression, tf::fill_rule rule,
                              const std::array<winding_range, operand_count>& ranges) {
    std::optional<bool> common;
    std::array<std::int64_t, operand_count> winding{};
    for (std::size_t k = 0; k < operand_count; ++k) winding[k] = ranges[k].low;
    for (;;) {
        std::array<bool, operand_count> in{};
        for (std::size_t k = 0; k < operand_count; ++k) in[k] = is_filled(rule, winding[k]);
        const bool here = expression(in);
        if (common && *common != here) return std::nullopt;
        common = here;
        std::size_t k = 0;
        while (k < operand_count && ++winding[k] > ranges[k].high) {
            winding[k] = ranges[k].low;
            ++k;
        }
        if (k == operand_count) return common;
    }
}

}  // namespace

TEST_CASE("partial_expression: known is what all winding numbers agree on") {
    test::random source(1);
    std::size_t known = 0, unknown = 0, missed = 0;
    for (int i = 0; i < 2000; ++i) {
        const tf::boolean_expression expression(nested_formula(source, 4), operand_count);
        const auto rule = static_cast<tf::fill_rule>(source.below(3));
        partial_expression state(expression, rule);
        std::array<winding_range, operand_count> ranges{};
        CHECK(state.value() == expression(std::array<bool, operand_count>{}));
        for (int step = 0; step < 20; ++step) {
            const std::size_t k = source.below(operand_count);
            const auto low = static_cast<std::int64_t>(source.below(4)) - 2;
            const winding_range next{low, low + static_cast<std::int64_t>(source.below(3))};
            state.add(static_cast<std::uint32_t>(k),
                      {next.low - ranges[k].low, next.high - ranges[k].high});
            ranges[k] = next;
            const auto found = state.value();
            const auto truth = by_trying(expression, rule, ranges);
            if (found) {
                ++known;
                CHECK(found == truth);
            } else {
                ++unknown;
                // An operand that comes twice, as in a-a, may hide that the value is known.
                if (truth) ++missed;
            }
            bool single = true;
            for (const winding_range& range : ranges) single = single && range.low == range.high;
            if (single) CHECK(found.has_value());
        }
    }
    CHECK(known > 10000);
    CHECK(unknown > 5000);
    CHECK(missed < unknown / 3);
}

TEST_CASE("partial_expression: a union of many changes where one operand does") {
    constexpr std::uint32_t many = 1000;
    partial_expression state(tf::boolean_expression::union_of(many), tf::fill_rule::nonzero);
    CHECK(state.value() == false);
    for (std::uint32_t k = 0; k < many; ++k) state.add(k, winding_range::unknown());
    CHECK(!state.value());
    state.add(17, {winding_range::unlimited + 1, 1 - winding_range::unlimited});
    CHECK(state.value() == true);
    state.add(17, {-1, -1});
    CHECK(!state.value());
}

TEST_CASE("partial_expression: formulas of one operand and of none") {
    partial_expression one(tf::boolean_expression("c", 3), tf::fill_rule::positive);
    CHECK(one.value() == false);
    one.add(0, winding_range::only(1));
    CHECK(one.value() == false);
    one.add(2, winding_range::only(1));
    CHECK(one.value() == true);
    one.add(2, {-2, 0});
    CHECK(!one.value());
    const partial_expression none(tf::boolean_expression::union_of(0), tf::fill_rule::nonzero);
    CHECK(none.value() == false);
}
