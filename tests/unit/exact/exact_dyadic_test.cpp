#include <libmesh/exact/dyadic.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/random.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace {

using test::greatest;
using test::infinity;
using test::least;
using tf::detail::exact::double_format;
using tf::detail::exact::dyadic;
using tf::detail::exact::float_format_32;
using tf::detail::exact::quotient;
using tf::detail::exact::sign_of;

bool same(const dyadic& a, const dyadic& b) { return sign_of(a - b) == 0; }

dyadic power(int exponent) { return dyadic(1, false, exponent); }

/// Any finite double, often with few bits.
double any_double(test::random& random) {
    for (;;) {
        std::uint64_t bits = random.bits();
        if (random.below(2) == 0) bits &= ~std::uint64_t{0} << random.below(53);
        if (random.below(4) == 0) bits &= 0x800fffffffffffff;
        const auto x = std::bit_cast<double>(bits);
        if (std::isfinite(x)) return x;
    }
}

/// A number of up to `limbs` limbs, with runs of zeros and ones.
dyadic any_dyadic(test::random& random, std::size_t limbs) {
    if (limbs == 0) return {};
    const dyadic rest = any_dyadic(random, limbs - 1);
    if (random.below(3) == 0) return rest;
    const std::uint64_t limb = random.below(3) == 0 ? ~std::uint64_t{0} : random.bits();
    return rest + dyadic(limb, random.below(3) == 0, 64 * static_cast<int>(limbs) - 640);
}

TEST_CASE("a dyadic is the double it was made from, the least and the greatest too") {
    CHECK(sign_of(dyadic(0.0)) == 0);
    CHECK(sign_of(dyadic(-0.0)) == 0);
    CHECK(same(dyadic(least), power(-1074)));
    CHECK(same(dyadic(-least), dyadic(1, true, -1074)));
    CHECK(same(dyadic(greatest), power(1024) - power(971)));
    CHECK(same(dyadic(0.75), power(-1) + power(-2)));
    test::random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double x = any_double(random);
        REQUIRE(quotient(dyadic(x), dyadic(1.0), 0, double_format).value == x);
        REQUIRE(quotient(dyadic(x), dyadic(1.0), 0, double_format).exact);
        REQUIRE(sign_of(dyadic(x)) == (x > 0) - (x < 0));
    }
}

TEST_CASE("small numbers add, subtract and multiply as whole numbers do") {
    test::random random(2);
    for (int i = 0; i < 2000; ++i) {
        const auto whole = [&] {
            return static_cast<std::int64_t>(random.bits()) >> (2 + random.below(62));
        };
        const std::int64_t a = whole(), b = whole();
        const auto exact = [](std::int64_t x) {
            return dyadic(static_cast<std::uint64_t>(x < 0 ? -x : x), x < 0, 0);
        };
        REQUIRE(same(exact(a) + exact(b), exact(a + b)));
        REQUIRE(same(exact(a) - exact(b), exact(a - b)));
        REQUIRE(sign_of(exact(a) - exact(b)) == (a > b) - (a < b));
        const std::int64_t c = a >> 32, d = b >> 32;
        REQUIRE(same(exact(c) * exact(d), exact(c * d)));
    }
}

TEST_CASE("sums and products of any size obey the laws of a ring") {
    test::random random(3);
    for (int i = 0; i < 1000; ++i) {
        const dyadic a = any_dyadic(random, random.below(40));
        const dyadic b = any_dyadic(random, random.below(40));
        const dyadic c = any_dyadic(random, random.below(20));
        REQUIRE(same(a + b, b + a));
        REQUIRE(same((a + b) - b, a));
        REQUIRE(same((a - b) + b, a));
        REQUIRE(same((a + b) + c, a + (b + c)));
        REQUIRE(same(a * b, b * a));
        REQUIRE(same((a + b) * c, a * c + b * c));
        REQUIRE(same((a * b) * c, a * (b * c)));
        REQUIRE(same((a - b) * (a + b), a * a - b * b));
        REQUIRE(sign_of(a * b) == sign_of(a) * sign_of(b));
        REQUIRE(sign_of(a - b) == -sign_of(b - a));
        REQUIRE(same(a * power(-1000) * power(1000), a));
        REQUIRE(sign_of(a * a + power(-5000)) == 1);
    }
}

TEST_CASE("numbers far apart keep all their bits") {
    const dyadic large = power(5000);
    const dyadic small = power(-5000);
    CHECK(same((large + small) - large, small));
    CHECK(same((large - small) * (large + small), power(10000) - power(-10000)));
    CHECK(sign_of(small - large) == -1);
    CHECK((large * power(-1)).size() == 1);
}

TEST_CASE("copies and moves keep the value, on the heap or off it") {
    test::random random(4);
    for (const std::size_t limbs : {std::size_t{1}, std::size_t{20}, std::size_t{60}}) {
        const dyadic a = any_dyadic(random, limbs) + power(700);
        dyadic copy = a;
        CHECK(same(copy, a));
        const dyadic moved = std::move(copy);
        CHECK(same(moved, a));
    }
}

TEST_CASE("a quotient of doubles is what the processor divides, denormals and overflow included") {
    test::random random(5);
    for (int i = 0; i < 20000; ++i) {
        const double x = any_double(random);
        double y = any_double(random);
        if (random.below(3) == 0) y = std::ldexp(y, -std::ilogb(y == 0 ? 1.0 : y));
        if (y == 0) continue;
        const auto q = quotient(dyadic(x), dyadic(y), 0, double_format);
        const double expected = x / y == 0 ? 0.0 : x / y;
        REQUIRE(std::bit_cast<std::uint64_t>(q.value) == std::bit_cast<std::uint64_t>(expected));
        REQUIRE(q.exact ==
                (std::isfinite(q.value) && same(dyadic(q.value) * dyadic(y), dyadic(x))));
    }
}

TEST_CASE("a quotient of floats is what the processor divides") {
    test::random random(6);
    const auto any_float = [&] {
        for (;;) {
            const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
            if (std::isfinite(x)) return x;
        }
    };
    for (int i = 0; i < 20000; ++i) {
        const float x = any_float(), y = any_float();
        if (y == 0) continue;
        volatile float expected = x / y;
        REQUIRE(quotient(dyadic(static_cast<double>(x)), dyadic(static_cast<double>(y)), 0,
                         float_format_32)
                    .value == static_cast<double>(expected));
    }
}

TEST_CASE("a quotient rounds ties to even and sees the last bit of any size") {
    const dyadic one = power(0);
    const dyadic tiny = power(-3000);
    const auto rounded = [&](const dyadic& a) { return quotient(a, one, 0, double_format).value; };
    const dyadic tie = one + power(-53);
    CHECK(rounded(tie) == 1.0);
    CHECK(rounded(tie + tiny) == 1.0 + 0x1p-52);
    CHECK(rounded(tie - tiny) == 1.0);
    const dyadic odd_tie = tie + power(-52);
    CHECK(rounded(odd_tie) == 1.0 + 0x1p-51);
    CHECK(rounded(odd_tie - tiny) == 1.0 + 0x1p-52);
    CHECK(rounded(power(-1075)) == 0.0);
    CHECK_FALSE(std::signbit(rounded(dyadic(1, true, -1075))));
    CHECK(rounded(power(-1075) + tiny) == least);
    CHECK(rounded(power(-1075) * dyadic(3.0)) == 2 * least);
    CHECK(rounded(power(1024) - power(970)) == infinity);
    CHECK(rounded(power(1024) - power(970) - tiny) == greatest);
    CHECK(quotient(one, dyadic(-3.0), 2, double_format).value == -4.0 / 3.0);
    CHECK(quotient(one, power(0) + tiny, 0, double_format).value == 1.0);
    CHECK_FALSE(quotient(one, power(0) + tiny, 0, double_format).exact);
    CHECK(quotient(dyadic(), one, 0, double_format).exact);
    CHECK(quotient(power(128) - power(103), one, 0, float_format_32).value == infinity);
    CHECK(quotient(power(-150), one, 0, float_format_32).value == 0.0);
    CHECK(quotient(power(-150) + tiny, one, 0, float_format_32).value == 0x1p-149);
}

TEST_CASE("the quotient of a product by a factor is the other factor") {
    test::random random(7);
    for (int i = 0; i < 2000; ++i) {
        const double x = any_double(random);
        const dyadic b = any_dyadic(random, 1 + random.below(40)) + power(900);
        const int shift = static_cast<int>(random.below(4000)) - 2000;
        const auto q = quotient(dyadic(x) * b * power(-shift), b, shift, double_format);
        REQUIRE(q.value == x);
        REQUIRE(q.exact);
    }
}

}  // namespace
