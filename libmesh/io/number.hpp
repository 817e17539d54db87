#pragma once
/// \file
/// Parses doubles and integers, without locale and allocation.

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace treeform::detail::io {

/// A number, and the first byte after it; `end` is null if no number starts there.
template <class T>
struct parsed {
    T value{};
    const char* end = nullptr;
    bool hexadecimal = false;  ///< written as 0x1.8p1
};

[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
[[nodiscard]] constexpr bool is_newline(char c) { return c == '\n' || c == '\r'; }
[[nodiscard]] constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
[[nodiscard]] constexpr bool is_space(char c) { return is_blank(c) || is_newline(c); }
[[nodiscard]] constexpr char to_lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Whether the text at `at` starts with `word`, ignoring case. \pre `word` is in lower case
[[nodiscard]] constexpr bool starts_with_word(const char* at, const char* end,
                                              std::string_view word) {
    if (static_cast<std::size_t>(end - at) < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (to_lower(at[i]) != word[i]) return false;
    return true;
}

/// The powers of ten that are exact in double.
inline constexpr double exact_power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// "nan", "inf" or "infinity" in any case, without a sign.
template <class T>
[[nodiscard]] parsed<T> parse_nonfinite(const char* at, const char* end) {
    if (starts_with_word(at, end, "nan")) return {std::numeric_limits<T>::quiet_NaN(), at + 3};
    if (starts_with_word(at, end, "infinity")) return {std::numeric_limits<T>::infinity(), at + 8};
    if (starts_with_word(at, end, "inf")) return {std::numeric_limits<T>::infinity(), at + 3};
    return {};
}

/// "0x1.8p1", which is 3, without a sign. A value beyond the range of T is not a number.
template <class T>
[[nodiscard]] parsed<T> parse_hexadecimal(const char* at, const char* end) {
    const auto starts_digits = [](char c) {
        return is_digit(c) || (to_lower(c) >= 'a' && to_lower(c) <= 'f') || c == '.';
    };
    if (!starts_with_word(at, end, "0x") || end - at < 3 || !starts_digits(at[2])) return {};
    parsed<T> n{.hexadecimal = true};
    const auto [stop, error] = std::from_chars(at + 2, end, n.value, std::chars_format::hex);
    if (error != std::errc{}) return {};
    n.end = stop;
    return n;
}

/// Digits, point and exponent of an unsigned decimal number.
struct decimal {
    std::uint64_t digits = 0;   ///< all digits as one integer, if there are at most 19
    std::int64_t count = 0;     ///< number of digits, leading zeros included
    std::int64_t exponent = 0;  ///< value = digits * 10^exponent
    const char* end = nullptr;  ///< null if there is no digit
};

[[nodiscard]] inline decimal scan_decimal(const char* at, const char* end) {
    decimal d;
    const char* const first = at;
    for (; at < end && is_digit(*at); ++at)
        d.digits = d.digits * 10 + static_cast<std::uint64_t>(*at - '0');
    d.count = at - first;
    if (at < end && *at == '.') {
        const char* const point = ++at;
        for (; at < end && is_digit(*at); ++at)
            d.digits = d.digits * 10 + static_cast<std::uint64_t>(*at - '0');
        d.exponent = -(at - point);
        d.count += at - point;
    }
    if (d.count == 0) return d;
    d.end = at;
    if (at < end && (*at == 'e' || *at == 'E')) {
        ++at;
        const bool negative = at < end && *at == '-';
        if (at < end && (*at == '-' || *at == '+')) ++at;
        if (at == end || !is_digit(*at)) return d;  // the number ends before the letter
        std::int64_t written = 0;
        for (; at < end && is_digit(*at); ++at)
            if (written < 1'000'000'000'000) written = written * 10 + (*at - '0');
        d.exponent += negative ? -written : written;
        d.end = at;
    }
    return d;
}

/// The value of text that std::from_chars finds out of range: zero or infinity, by the position of
/// the first nonzero digit.
template <class T>
[[nodiscard]] T out_of_range_value(const char* at, const char* end, const decimal& d) {
    std::int64_t leading_zeros = 0;
    for (; at < end && (*at == '0' || *at == '.'); ++at) leading_zeros += *at == '0' ? 1 : 0;
    return d.count - leading_zeros + d.exponent > 0 ? std::numeric_limits<T>::infinity() : T{0};
}

/// The number that starts at `at`, rounded once to the nearest T (ties to even): [+-] digits with
/// an optional point and exponent, or nan, inf, infinity in any case, or hexadecimal digits after
/// 0x, as for strtod. Decimal numbers out of range become infinity or zero. Text after the number
/// is left to the caller.
///
/// Exact shortcut for doubles: with at most 19 digits the integer is exact in 64 bits; if it is at
/// most 2^53 and the power of ten at most 10^22, both are exact doubles, and one multiplication or
/// division gives the nearest double (Clinger, How to read floating point numbers accurately, PLDI
/// 1990). It requires the rounding mode to-nearest, which is the default.
template <class T = double>
[[nodiscard]] parsed<T> parse_number(const char* at, const char* end) {
    const bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) ++at;
    const decimal d = scan_decimal(at, end);
    parsed<T> result{T{0}, d.end};
    if (d.end == nullptr) {
        result = parse_nonfinite<T>(at, end);
    } else if (sizeof(T) == sizeof(double) && d.count <= 19 &&
               d.digits <= (std::uint64_t{1} << 53) && d.exponent >= -22 && d.exponent <= 22) {
        const auto digits = static_cast<double>(d.digits);
        result.value = static_cast<T>(d.exponent < 0 ? digits / exact_power_of_ten[-d.exponent]
                                                     : digits * exact_power_of_ten[d.exponent]);
    } else {
        const auto [stop, error] = std::from_chars(at, d.end, result.value);
        if (error == std::errc::result_out_of_range)
            result.value = out_of_range_value<T>(at, d.end, d);
    }
    if (d.digits == 0 && d.end != nullptr && d.end != end && to_lower(*d.end) == 'x')
        if (const parsed<T> n = parse_hexadecimal<T>(at, end); n.end != nullptr) result = n;
    if (negative) result.value = -result.value;
    return result;
}

/// An integer with an optional sign. Values beyond 2^40 are returned as some value beyond 2^40,
/// since no index or count is that large.
[[nodiscard]] inline parsed<std::int64_t> parse_integer(const char* at, const char* end) {
    constexpr std::int64_t huge = std::int64_t{1} << 40;
    const bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) ++at;
    if (at == end || !is_digit(*at)) return {};
    std::int64_t value = 0;
    for (; at < end && is_digit(*at); ++at)
        if (value <= huge) value = value * 10 + (*at - '0');
    return {negative ? -value : value, at};
}

/// Whether x is a value of the integer type T. The limits are powers of two, which are exact in
/// double.
template <class T>
requires std::is_integral_v<T>
[[nodiscard]] bool is_value_of(double x) {
    constexpr T half = std::numeric_limits<T>::max() / 2 + 1;
    constexpr double beyond = 2.0 * static_cast<double>(half);
    constexpr auto least = static_cast<double>(std::numeric_limits<T>::min());
    return x >= least && x < beyond && x == std::floor(x);
}

}  // namespace treeform::detail::io
