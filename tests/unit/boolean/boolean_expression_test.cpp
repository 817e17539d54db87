#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace {

using tf::boolean_expression;

/// The values for all sets of the operands; bit i of an index is operand i.
std::string table(const boolean_expression& expression) {
    const std::size_t count = expression.operand_count();
    std::string values;
    for (std::size_t set = 0; set < std::size_t{1} << count; ++set) {
        std::array<bool, 8> in{};
        for (std::size_t i = 0; i < count; ++i) in[i] = (set >> i & 1) != 0;
        values += expression({in.data(), count}) ? '1' : '0';
    }
    return values;
}

std::string table(const std::string& text, std::size_t count) {
    return table(boolean_expression(text, count));
}

std::string complaint(const std::string& text, std::size_t count) {
    try {
        const boolean_expression read(text, count);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return {};
}

/// A random formula in brackets everywhere, and its value.
struct formula {
    std::string text;
    bool value;
};

formula random_formula(test::random& source, const std::array<bool, 8>& in, int depth) {
    if (depth == 0 || source.below(4) == 0) {
        const std::size_t i = source.below(in.size());
        return {std::string(1, static_cast<char>('a' + i)), in[i]};
    }
    const formula l = random_formula(source, in, depth - 1);
    const formula r = random_formula(source, in, depth - 1);
    const std::size_t which = source.below(6);
    const std::array<bool, 6> values{l.value || r.value, l.value || r.value,  l.value && r.value,
                                     l.value && r.value, l.value && !r.value, l.value != r.value};
    return {"(" + l.text + " " + std::string(1, "+|*&-^"[which]) + r.text + ")", values[which]};
}

}  // namespace

TEST_CASE("expression: each operation is its own") {
    CHECK(table("a", 1) == "01");
    CHECK(table("a+b", 2) == "0111");
    CHECK(table("a|b", 2) == "0111");
    CHECK(table("a*b", 2) == "0001");
    CHECK(table("a&b", 2) == "0001");
    CHECK(table("a-b", 2) == "0100");
    CHECK(table("a^b", 2) == "0110");
}

TEST_CASE("expression: products bind tighter, the rest goes from left to right") {
    CHECK(table("a+b*c", 3) == table("a+(b*c)", 3));
    CHECK(table("a*b+c", 3) == table("(a*b)+c", 3));
    CHECK(table("a-b+c", 3) == table("(a-b)+c", 3));
    CHECK(table("a-b+c", 3) != table("a-(b+c)", 3));
    CHECK(table("a-b-c", 3) == table("a-(b+c)", 3));
    CHECK(table("a-b*c-d", 4) == table("(a-(b*c))-d", 4));
    CHECK(table("a^b+c", 3) == table("(a^b)+c", 3));
    CHECK(table(" A\t- (( b ))", 2) == table("a-b", 2));
}

TEST_CASE("expression: the named operations are the formulas they stand for") {
    CHECK(table(boolean_expression::union_of(3)) == table("a+b+c", 3));
    CHECK(table(boolean_expression::intersection_of(3)) == table("a*b*c", 3));
    CHECK(table(boolean_expression::difference_of(3)) == table("a-b-c", 3));
    CHECK(table(boolean_expression::symmetric_difference_of(3)) == "01101001");
    CHECK(table(boolean_expression::union_of(1)) == "01");
    CHECK(table(boolean_expression::union_of(0)) == "0");
}

TEST_CASE("expression: operands beyond z have two letters") {
    const auto in_only = [](std::size_t operand, const std::string& text) {
        std::array<bool, 702> in{};
        in[operand] = true;
        return boolean_expression(text, in.size())({in.data(), in.size()});
    };
    CHECK(in_only(25, "z"));
    CHECK(in_only(26, "aa"));
    CHECK(in_only(27, "ab"));
    CHECK(in_only(52, "ba"));
    CHECK(in_only(701, "zz"));
    CHECK_FALSE(in_only(26, "z"));
    CHECK(complaint("aaa", 702).find("702 operands") != std::string::npos);
}

TEST_CASE("expression: what cannot be read is named with its position") {
    const auto names = [](const std::string& text, std::size_t count, const std::string& part) {
        CAPTURE(text);
        CHECK(complaint(text, count).find(part) != std::string::npos);
    };
    names("", 2, "position 1 ");
    names("a+", 2, "position 3 ");
    names("a+*b", 2, "position 3 ");
    names("a b", 2, "position 3 ");
    names("a+(b", 2, "position 3 ");
    names("a+b)", 2, "position 4 ");
    names("()", 2, "position 2 ");
    names("a-c", 2, "position 3 ");
    names("a~b", 2, "position 2 ");
    names("-a", 2, "position 1 ");
    names("a", 0, "0 operands");
    names("b", 1, "1 operand only");
    names(std::string(100, 'z'), 30, "position 1 ");
    CHECK(complaint("(a-b)*(a+b)", 2).empty());
}

TEST_CASE("expression: deep brackets are no deep recursion") {
    const std::size_t depth = 200000;
    const std::string text = std::string(depth, '(') + "a" + std::string(depth, ')');
    CHECK(table(text, 1) == "01");
    CHECK_FALSE(complaint(std::string(depth, '('), 1).empty());
}

TEST_CASE("expression: random formulas have the values they were made with") {
    test::random source(1);
    for (int round = 0; round < 500; ++round) {
        std::array<bool, 8> in{};
        for (bool& value : in) value = source.below(2) == 1;
        const formula made = random_formula(source, in, 6);
        CAPTURE(made.text);
        CHECK(boolean_expression(made.text, in.size())({in.data(), in.size()}) == made.value);
    }
}

TEST_CASE("boolean expression: what it is_inside is false without it") {
    const auto is_inside = [](const char* text, std::size_t operand) {
        return tf::boolean_expression(text, 3).is_inside(operand);
    };
    CHECK(is_inside("a-b", 0));
    CHECK_FALSE(is_inside("a-b", 1));
    CHECK(is_inside("a*b", 0));
    CHECK(is_inside("a*b", 1));
    CHECK_FALSE(is_inside("a+b", 0));
    CHECK_FALSE(is_inside("a^b", 0));
    CHECK(is_inside("(b+c)*a-c", 0));
    CHECK(is_inside("(a-b)+(a-c)", 0));
    CHECK_FALSE(is_inside("(a-b)+(c-b)", 0));
    CHECK(tf::boolean_expression::union_of(0).is_inside(0));
}

TEST_CASE("expression: names of operands") {
    const std::vector<std::string> names{"body", "bolt_1", "left bolt", "a-b"};
    const boolean_expression formula("body - (bolt_1 + 'left bolt')*\"a-b\"", names);
    const auto value = [&](bool body, bool bolt, bool left, bool other) {
        const std::array in{body, bolt, left, other};
        return formula(in);
    };
    CHECK(value(true, false, false, false));
    CHECK_FALSE(value(true, true, false, true));
    CHECK_FALSE(value(true, false, true, true));
    CHECK(value(true, true, true, false));
    CHECK(boolean_expression::names_in("body-(x.2+'left bolt')-body") ==
          std::vector<std::string>{"body", "x.2", "left bolt"});
    const auto complaint_of = [&](const char* text) {
        try {
            static_cast<void>(boolean_expression(text, names));
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(complaint_of("body-nut") ==
          "treeform::boolean_expression: position 6 of \"body-nut\": no operand is named nut; "
          "the names are body, bolt_1, left bolt, a-b");
    CHECK(complaint_of("body-'bolt").ends_with("this quote is not closed"));
    CHECK_FALSE(complaint_of("body bolt_1").empty());
    CHECK_FALSE(complaint_of("Body").empty());  // the case of letters matters
    CHECK_THROWS_AS((void)boolean_expression::names_in("a-(b"), std::invalid_argument);
}
