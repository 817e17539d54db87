#pragma once
/// \file
/// Integers with a fixed number of 64-bit limbs, in two's complement.

#include <libmesh/exact/word.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::exact {

/// An integer in [-2^(64 L - 1), 2^(64 L - 1)). A product is as wide as its factors together and
/// always fits. Sums keep the width; the caller must ensure that they fit.
template <std::size_t Limbs>
struct integer {
    std::array<std::uint64_t, Limbs> limbs;  ///< lowest first

    [[nodiscard]] constexpr bool negative() const {
        return static_cast<std::int64_t>(limbs[Limbs - 1]) < 0;
    }
    friend constexpr bool operator==(const integer&, const integer&) = default;
};

template <std::size_t Limbs>
constexpr integer<Limbs> operator+(const integer<Limbs>& a, const integer<Limbs>& b) {
    integer<Limbs> result;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
        const uint128 t = uint128{a.limbs[i]} + b.limbs[i] + carry;
        result.limbs[i] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
    }
    return result;
}

template <std::size_t Limbs>
constexpr integer<Limbs> operator-(const integer<Limbs>& a, const integer<Limbs>& b) {
    integer<Limbs> result;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
        const uint128 t = uint128{a.limbs[i]} - b.limbs[i] - borrow;
        result.limbs[i] = static_cast<std::uint64_t>(t);
        borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
    return result;
}

/// If `condition`, subtracts `a` from the limbs [From, From + N) of `result`.
template <std::size_t From, std::size_t Limbs, std::size_t N>
constexpr void subtract_if(bool condition, integer<Limbs>& result, const integer<N>& a) {
    const std::uint64_t mask = condition ? ~std::uint64_t{0} : 0;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const uint128 t = uint128{result.limbs[From + i]} - (a.limbs[i] & mask) - borrow;
        result.limbs[From + i] = static_cast<std::uint64_t>(t);
        borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
}

/// Product of an integer and one signed limb: the lower limbs are unsigned, the top one is signed.
template <std::size_t A>
constexpr integer<A + 1> operator*(const integer<A>& a, const integer<1>& b) {
    const std::uint64_t factor = b.limbs[0];
    const std::uint64_t negative = b.negative() ? ~std::uint64_t{0} : 0;
    integer<A + 1> result;
    // A limb times the factor is at least -2^127 + 2^63 and at most 2^127 - 2^64 - 2^63 + 1, and
    // the carry is at least -2^63 and less than 2^63, so their sum fits.
    int128 carry = 0;
    for (std::size_t i = 0; i + 1 < A; ++i) {
        const uint128 borrow = uint128{a.limbs[i] & negative} << 64;
        const int128 t = static_cast<int128>(uint128{a.limbs[i]} * factor - borrow) + carry;
        result.limbs[i] = static_cast<std::uint64_t>(t);
        carry = t >> 64;
    }
    const int128 top =
        int128{static_cast<std::int64_t>(a.limbs[A - 1])} * static_cast<std::int64_t>(factor) +
        carry;
    result.limbs[A - 1] = static_cast<std::uint64_t>(top);
    result.limbs[A] = static_cast<std::uint64_t>(top >> 64);
    return result;
}

/// The magnitude of an integer, and the range [first, last) of its nonzero limbs.
template <std::size_t Limbs>
struct magnitude {
    integer<Limbs> value;  ///< interpreted as unsigned
    std::size_t first = 0;
    std::size_t last = Limbs;
};

template <std::size_t Limbs>
constexpr magnitude<Limbs> magnitude_of(const integer<Limbs>& a) {
    magnitude<Limbs> result{a.negative() ? integer<Limbs>{} - a : a};
    while (result.last > 0 && result.value.limbs[result.last - 1] == 0) --result.last;
    while (result.first < result.last && result.value.limbs[result.first] == 0) ++result.first;
    return result;
}

/// Product of wide integers with few nonzero limbs: numbers of a common scale have low zero limbs,
/// small numbers have high ones. \cost by the limbs in between.
template <std::size_t A, std::size_t B>
constexpr integer<A + B> wide_product(const integer<A>& a, const integer<B>& b) {
    const magnitude<A> x = magnitude_of(a);
    const magnitude<B> y = magnitude_of(b);
    integer<A + B> result{};
    for (std::size_t j = y.first; j < y.last; ++j) {
        std::uint64_t carry = 0;
        for (std::size_t i = x.first; i < x.last; ++i) {
            const uint128 t =
                uint128{x.value.limbs[i]} * y.value.limbs[j] + result.limbs[i + j] + carry;
            result.limbs[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        result.limbs[j + x.last] = carry;
    }
    return a.negative() != b.negative() ? integer<A + B>{} - result : result;
}

/// Schoolbook product of the limbs as unsigned numbers, then corrected: a negative factor, as
/// unsigned, is larger by 2^(64 A), which adds 2^(64 A) times the other factor to the product.
template <std::size_t A, std::size_t B>
constexpr integer<A + B> operator*(const integer<A>& a, const integer<B>& b) {
    constexpr std::size_t widest_in_full = 8;
    if constexpr (A > widest_in_full || B > widest_in_full) return wide_product(a, b);
    integer<A + B> result{};
    for (std::size_t j = 0; j < B; ++j) {
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < A; ++i) {
            const uint128 t = uint128{a.limbs[i]} * b.limbs[j] + result.limbs[i + j] + carry;
            result.limbs[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        result.limbs[j + A] = carry;
    }
    subtract_if<A>(a.negative(), result, b);
    subtract_if<B>(b.negative(), result, a);
    return result;
}

template <std::size_t Limbs>
constexpr int sign_of(const integer<Limbs>& a) {
    if (a.negative()) return -1;
    std::uint64_t any = 0;
    for (const std::uint64_t limb : a.limbs) any |= limb;
    return any != 0;
}

}  // namespace treeform::detail::exact
