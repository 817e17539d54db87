#include <libmesh/exact/integer.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/stress_families.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace {

using tf::detail::exact::integer;
using tf::detail::exact::sign_of;

template <std::size_t Limbs>
bool bit(const integer<Limbs>& a, std::size_t i) {
    return (a.limbs[i / 64] >> (i % 64) & 1) != 0;
}

/// Addition a bit at a time.
template <std::size_t Limbs>
integer<Limbs> slow_sum(const integer<Limbs>& a, const integer<Limbs>& b) {
    integer<Limbs> result{};
    int carry = 0;
    for (std::size_t i = 0; i < 64 * Limbs; ++i) {
        const int digits = bit(a, i) + bit(b, i) + carry;
        if (digits % 2 != 0) result.limbs[i / 64] |= std::uint64_t{1} << (i % 64);
        carry = digits / 2;
    }
    return result;
}

template <std::size_t Limbs>
integer<Limbs> slow_negative(integer<Limbs> a) {
    for (std::uint64_t& limb : a.limbs) limb = ~limb;
    integer<Limbs> one{};
    one.limbs[0] = 1;
    return slow_sum(a, one);
}

template <std::size_t Wide, std::size_t Limbs>
integer<Wide> widened(const integer<Limbs>& a) {
    integer<Wide> result{};
    for (std::size_t i = 0; i < Wide; ++i)
        result.limbs[i] = i < Limbs ? a.limbs[i] : (a.negative() ? ~std::uint64_t{0} : 0);
    return result;
}

/// Product by doubling and adding; the top bit of a two's complement number counts negative.
template <std::size_t A, std::size_t B>
integer<A + B> slow_product(const integer<A>& a, const integer<B>& b) {
    integer<A + B> power = widened<A + B>(a);
    integer<A + B> result{};
    for (std::size_t i = 0; i < 64 * B; ++i) {
        if (bit(b, i)) result = slow_sum(result, i + 1 < 64 * B ? power : slow_negative(power));
        power = slow_sum(power, power);
    }
    return result;
}

/// Limbs that are often all ones, all zeros or a single top bit: carries run far. Every third one
/// has zeros below some limb and copies of its sign above another.
template <std::size_t Limbs>
integer<Limbs> any_integer(tf::test::random_source& random) {
    integer<Limbs> result{};
    for (std::uint64_t& limb : result.limbs) {
        switch (random.below(5)) {
            case 0:
                limb = 0;
                break;
            case 1:
                limb = ~std::uint64_t{0};
                break;
            case 2:
                limb = std::uint64_t{1} << 63;
                break;
            default:
                limb = random.below(std::numeric_limits<std::uint64_t>::max());
        }
    }
    if (random.below(3) == 0) {
        const std::size_t last = random.below(Limbs + 1);
        const bool negative = last > 0 && result.limbs[last - 1] >> 63 != 0;
        std::fill_n(result.limbs.begin(), random.below(last + 1), 0);
        std::fill(result.limbs.begin() + static_cast<std::ptrdiff_t>(last), result.limbs.end(),
                  negative ? ~std::uint64_t{0} : 0);
    }
    return result;
}

template <std::size_t A, std::size_t B>
void check_products(int count) {
    tf::test::random_source random(A * 100 + B);
    for (int i = 0; i < count; ++i) {
        const auto a = any_integer<A>(random);
        const auto b = any_integer<B>(random);
        REQUIRE(a * b == slow_product(a, b));
        REQUIRE(a * b == b * a);
        REQUIRE(sign_of(a * b) == sign_of(a) * sign_of(b));
    }
}

template <std::size_t Limbs>
void check_sums(int count) {
    tf::test::random_source random(Limbs);
    for (int i = 0; i < count; ++i) {
        const auto a = any_integer<Limbs>(random);
        const auto b = any_integer<Limbs>(random);
        REQUIRE(a + b == slow_sum(a, b));
        REQUIRE(a - b == slow_sum(a, slow_negative(b)));
    }
}

TEST_CASE("integers: the sign is that of the top limb, and zero only when all limbs are") {
    CHECK(sign_of(integer<1>{0}) == 0);
    CHECK(sign_of(integer<1>{1}) == 1);
    CHECK(sign_of(integer<1>{~std::uint64_t{0}}) == -1);
    CHECK(sign_of(integer<3>{0, 0, 0}) == 0);
    CHECK(sign_of(integer<3>{0, 1, 0}) == 1);
    CHECK(sign_of(integer<3>{1, 0, 0}) == 1);
    CHECK(sign_of(integer<3>{~std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63}) == -1);
}

TEST_CASE("integers: sums and differences agree with adding bit by bit") {
    check_sums<1>(500);
    check_sums<2>(500);
    check_sums<3>(500);
    check_sums<7>(200);
    check_sums<66>(20);
}

TEST_CASE("integers: products agree with doubling and adding") {
    check_products<1, 1>(500);
    check_products<2, 1>(500);
    check_products<4, 1>(200);
    check_products<2, 2>(300);
    check_products<3, 2>(200);
    check_products<8, 4>(50);
    check_products<16, 16>(40);
    check_products<9, 1>(40);
    check_products<66, 33>(9);
}

TEST_CASE("integers: the least one squared does not overflow") {
    const integer<1> one_limb{std::uint64_t{1} << 63};
    CHECK(one_limb * one_limb == integer<2>{0, std::uint64_t{1} << 62});
    const integer<2> two_limbs{0, std::uint64_t{1} << 63};
    CHECK(two_limbs * two_limbs == integer<4>{0, 0, 0, std::uint64_t{1} << 62});
    CHECK(two_limbs * one_limb == integer<3>{0, 0, std::uint64_t{1} << 62});
}

TEST_CASE("integers: a word product is right modulo 2^128 whatever its parts were") {
    using tf::detail::exact::double_word;
    using tf::detail::exact::word;
    const word big{std::numeric_limits<std::int64_t>::max()};
    const double_word square = big * big;
    const double_word wrapped = square * word{4} - square * word{3};  // the parts exceed 2^127
    CHECK(wrapped.bits == square.bits);
    CHECK(sign_of(word{-3} * word{5}) == -1);
    CHECK(sign_of(word{-3} * word{-5}) == 1);
    CHECK(sign_of(word{0} * word{-5}) == 0);
    CHECK(sign_of((word{-3} * word{5}) * word{-1}) == 1);
    CHECK(sign_of((word{-3} * word{5}) * (word{1} * word{2})) == -1);
}

}  // namespace
