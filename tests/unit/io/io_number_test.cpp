#include <libmesh/io/number.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace {

using tf::detail::io::parse_integer;
using tf::detail::io::parse_number;

/// The number in all of `text`; fails the test when something is left.
double number(const std::string& text) {
    const auto n = parse_number(text.data(), text.data() + text.size());
    CAPTURE(text);
    REQUIRE(n.end == text.data() + text.size());
    return n.value;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

double reference(const std::string& text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// A finite double with random bits.
double random_double(std::mt19937_64& random) {
    for (;;) {
        const auto value = std::bit_cast<double>(random());
        if (std::isfinite(value)) return value;
    }
}

std::string printed(const char* format, double value) {
    char text[512];
    const int size = std::snprintf(text, sizeof text, format, value);
    return {text, static_cast<std::size_t>(size)};
}

}  // namespace

TEST_CASE("numbers: plain, signed, with point and exponent") {
    CHECK(number("0") == 0.0);
    CHECK(number("17") == 17.0);
    CHECK(number("+17") == 17.0);
    CHECK(number("-.5") == -0.5);
    CHECK(number("5.") == 5.0);
    CHECK(number("1e3") == 1000.0);
    CHECK(number("1E+3") == 1000.0);
    CHECK(number("125e-3") == 0.125);
    CHECK(number("000000000000000000000000000001.5") == 1.5);
    CHECK(same_bits(number("-0"), -0.0));
    CHECK(same_bits(number("-0.0e5"), -0.0));
}

TEST_CASE("numbers: nan and infinity in any case") {
    CHECK(std::isnan(number("nan")));
    CHECK(std::isnan(number("-NaN")));
    CHECK(number("inf") == std::numeric_limits<double>::infinity());
    CHECK(number("-Inf") == -std::numeric_limits<double>::infinity());
    CHECK(number("+INFINITY") == std::numeric_limits<double>::infinity());
}

TEST_CASE("numbers: what starts no number is refused, and a number ends where it ends") {
    for (const std::string text : {"", "-", "+", ".", "-.", "e5", "x", "--1", "na", "in"}) {
        CAPTURE(text);
        CHECK(parse_number(text.data(), text.data() + text.size()).end == nullptr);
    }
    const auto length = [](const std::string& text) {
        return parse_number(text.data(), text.data() + text.size()).end - text.data();
    };
    CHECK(length("1e") == 1);
    CHECK(length("1e+") == 1);
    CHECK(length("1,5") == 1);
    CHECK(length("1.5.2") == 3);
    CHECK(length("0x10") == 4);
    CHECK(length("0x1.8p") == 5);
    CHECK(length("0xg") == 1);
    CHECK(length("0x") == 1);
    CHECK(length("0x1p5000") == 1);  // beyond the range: no number in hexadecimal
    CHECK(length("infinit") == 3);
}

TEST_CASE("numbers: beyond the range is infinity, below it zero") {
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(number("1e400") == infinity);
    CHECK(number("-1e400") == -infinity);
    CHECK(number("1e999999999999999999999") == infinity);
    CHECK(same_bits(number("1e-400"), 0.0));
    CHECK(same_bits(number("-1e-400"), -0.0));
    CHECK(same_bits(number("0e999999"), 0.0));
    CHECK(number("1.7976931348623157e308") == std::numeric_limits<double>::max());
    // Half a last place above the largest double goes to infinity, just below it does not.
    CHECK(number("1.7976931348623158079e308") == std::numeric_limits<double>::max());
    CHECK(number("1.797693134862315808e308") == infinity);
    CHECK(number(std::string(400, '0') + "." + std::string(400, '0') + "1e401") == 1.0);
}

TEST_CASE("numbers: denormals and halfway cases are rounded to even") {
    CHECK(number("4.9406564584124654e-324") == 0x1p-1074);
    CHECK(number("2.4703282292062327208e-324") == 0x0p0);  // just below half of it
    CHECK(number("2.4703282292062327209e-324") == 0x1p-1074);
    CHECK(number("2.2250738585072011e-308") == 0x0.fffffffffffffp-1022);
    CHECK(number("9007199254740992") == 0x1p53);
    CHECK(number("9007199254740993") == 0x1p53);                // halfway: down to even
    CHECK(number("9007199254740995") == 0x1.0000000000002p53);  // halfway: up to even
    CHECK(number("9007199254740993.0000000000000000000000001") == 0x1.0000000000001p53);
    CHECK(number("9007199254740991e22") == reference("9007199254740991e22"));
    CHECK(number("9007199254740993e-22") == reference("9007199254740993e-22"));
    CHECK(number("1e23") == reference("1e23"));
}

TEST_CASE("numbers: random doubles come back from seventeen digits and from the shortest text") {
    std::mt19937_64 random(1);
    for (int i = 0; i < 300'000; ++i) {
        const double value = random_double(random);
        CHECK(same_bits(number(printed("%.17g", value)), value));
        char text[32];
        const auto end = std::to_chars(text, text + 32, value).ptr;
        if (!same_bits(number(std::string(text, end)), value)) REQUIRE(value == 0.0);
    }
}

TEST_CASE("numbers: random doubles come back from hexadecimal") {
    std::mt19937_64 random(3);
    for (int i = 0; i < 100'000; ++i) {
        const double value = random_double(random);
        REQUIRE(same_bits(number(printed("%a", value)), value));
    }
    CHECK(same_bits(number("-0x0p0"), -0.0));
    CHECK(number("0x1.00000000000008p0") == 1.0);  // halfway: to even
    CHECK(number("0x1.00000000000018p0") == 0x1.0000000000002p0);
}

TEST_CASE("numbers: text as files have it is rounded as std::from_chars does") {
    std::mt19937_64 random(2);
    const char* const formats[] = {"%.6f", "%.3e", "%.9g", "%.8e", "%.15f", "%.17g", "%.25f", "%g"};
    for (int i = 0; i < 1'000'000; ++i) {
        // -1000 .. 1000 and, now and then, a magnitude from 1e-30 to 1e30.
        double value = static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63 * 1000.0;
        if (i % 4 == 0) value *= std::pow(10.0, static_cast<double>(random() % 61) - 30.0);
        const std::string text = printed(formats[random() % std::size(formats)], value);
        const double expected = reference(text);
        if (!same_bits(number(text), expected)) FAIL(text);
    }
}

TEST_CASE("numbers: floats are rounded once, not through double") {
    // Just above the middle of two floats; as a double it is that middle and would go to even.
    const std::string text = "1.00000017881393432617187500000000000001";
    const auto n = parse_number<float>(text.data(), text.data() + text.size());
    CHECK(n.value == std::nextafter(std::nextafter(1.0F, 2.0F), 2.0F));
    std::mt19937 random(3);
    for (int i = 0; i < 100'000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (!std::isfinite(value)) continue;
        char shortest[32];
        const char* const end = std::to_chars(shortest, shortest + 32, value).ptr;
        REQUIRE(parse_number<float>(shortest, end).value == value);
    }
}

TEST_CASE("integers: signs, leading zeros, and values no index can have") {
    const auto integer = [](const std::string& text) {
        const auto n = parse_integer(text.data(), text.data() + text.size());
        return n.end == nullptr ? std::int64_t{-99} : n.value;
    };
    CHECK(integer("12") == 12);
    CHECK(integer("+12") == 12);
    CHECK(integer("-12") == -12);
    CHECK(integer(std::string(500, '0') + "7") == 7);
    CHECK(integer("18446744073709551617") > (std::int64_t{1} << 40));
    CHECK(integer("-9223372036854775809") < -(std::int64_t{1} << 40));
    CHECK(integer("") == -99);
    CHECK(integer("-") == -99);
    CHECK(integer("x") == -99);
}
