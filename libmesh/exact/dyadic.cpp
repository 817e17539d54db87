#include <libmesh/exact/dyadic.hpp>
#include <libmesh/exact/lattice.hpp>
#include <libmesh/exact/word.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <vector>

namespace treeform::detail::exact {
namespace {

/// Adds the limbs to those at `to`, which has room for the carry.
void add_to(std::uint64_t* to, const std::uint64_t* limbs, std::size_t size) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const uint128 t = uint128{to[i]} + limbs[i] + carry;
        to[i] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
    }
    for (std::size_t i = size; carry != 0; ++i) carry = ++to[i] == 0;
}

/// Subtracts the limbs from those at `from`, which are not less.
void subtract_from(std::uint64_t* from, const std::uint64_t* limbs, std::size_t size) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const uint128 t = uint128{from[i]} - limbs[i] - borrow;
        from[i] = static_cast<std::uint64_t>(t);
        borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
    for (std::size_t i = size; borrow != 0; ++i) borrow = from[i]-- == 0;
}

/// The power of two above the highest limb.
int top_of(const dyadic& a) { return a.exponent() + static_cast<int>(a.size()); }

/// Sign of |a| - |b|. \pre neither is zero
int compare_magnitudes(const dyadic& a, const dyadic& b) {
    if (top_of(a) != top_of(b)) return top_of(a) < top_of(b) ? -1 : 1;
    const std::size_t common = std::min(a.size(), b.size());
    const std::uint64_t* p = a.limbs() + a.size();
    const std::uint64_t* q = b.limbs() + b.size();
    for (std::size_t i = 0; i < common; ++i)
        if (*--p != *--q) return *p < *q ? -1 : 1;
    return a.size() < b.size() ? -1 : a.size() > b.size();  // the lowest limb is not zero
}

}  // namespace

dyadic::dyadic(std::size_t size, int exponent, bool negative)
    : size_(size), exponent_(exponent), negative_(negative) {
    reserve(size);
}

dyadic::dyadic(std::uint64_t magnitude, bool negative, int shift) : negative_(negative) {
    if (magnitude == 0) return;
    exponent_ = shift >> 6;
    const uint128 spread = uint128{magnitude} << (shift & 63);
    near_[0] = static_cast<std::uint64_t>(spread);
    near_[1] = static_cast<std::uint64_t>(spread >> 64);
    size_ = 2;
    trim();
}

dyadic::dyadic(std::span<const std::uint64_t> magnitude, bool negative) : negative_(negative) {
    std::size_t size = magnitude.size();
    while (size > 0 && magnitude[size - 1] == 0) --size;
    if (size == 0) return;
    reserve(size);
    size_ = size;
    std::copy_n(magnitude.data(), size, limbs());
    trim();
}

dyadic::dyadic(double x) {
    constexpr int unit = 1088;  // whole limbs, and above 1075
    const odd_part p = odd_part_of(x);
    if (p.odd == 0) return;
    assign(dyadic(p.odd, p.negative != 0, p.lowest - 1075 + unit));
    exponent_ -= unit / 64;
}

dyadic::dyadic(const dyadic& other) { assign(other); }

dyadic::dyadic(dyadic&& other) noexcept
    : size_(other.size_),
      exponent_(other.exponent_),
      negative_(other.negative_),
      heap_(std::move(other.heap_)) {
    if (!heap_) std::copy_n(other.near_.data(), size_, near_.data());
    other.size_ = 0;
}

dyadic::dyadic(const dyadic& a, const dyadic& b, bool b_negative) {
    if (b.size_ == 0) {
        assign(a);
    } else if (a.size_ == 0) {
        assign(b);
        negative_ = b_negative;
    } else if (a.negative_ == b_negative) {
        negative_ = b_negative;
        assign_sum(a, b);
    } else if (const int order = compare_magnitudes(a, b); order != 0) {
        negative_ = order > 0 ? a.negative_ : b_negative;
        assign_difference(order > 0 ? a : b, order > 0 ? b : a);
    }
}

void dyadic::reserve(std::size_t size) {
    if (size > near_limbs) heap_ = std::make_unique_for_overwrite<std::uint64_t[]>(size);
}

void dyadic::assign(const dyadic& other) {
    reserve(other.size_);
    size_ = other.size_;
    exponent_ = other.exponent_;
    negative_ = other.negative_;
    std::copy_n(other.limbs(), size_, limbs());
}

/// Sets all limbs to those of `other`, at their powers of two.
void dyadic::place(const dyadic& other) {
    std::uint64_t* const to = limbs();
    const auto below = static_cast<std::size_t>(other.exponent_ - exponent_);
    std::fill_n(to, below, 0);
    std::copy_n(other.limbs(), other.size_, to + below);
    std::fill(to + below + other.size_, to + size_, 0);
}

void dyadic::assign_sum(const dyadic& a, const dyadic& b) {
    exponent_ = std::min(a.exponent_, b.exponent_);
    size_ = static_cast<std::size_t>(std::max(top_of(a), top_of(b)) - exponent_) + 1;
    reserve(size_);
    place(a);
    add_to(limbs() + (b.exponent_ - exponent_), b.limbs(), b.size_);
    trim();
}

void dyadic::assign_difference(const dyadic& larger, const dyadic& smaller) {
    exponent_ = std::min(larger.exponent_, smaller.exponent_);
    size_ = static_cast<std::size_t>(top_of(larger) - exponent_);
    reserve(size_);
    place(larger);
    subtract_from(limbs() + (smaller.exponent_ - exponent_), smaller.limbs(), smaller.size_);
    trim();
}

/// Drops limbs that are zero at either end. \pre the value is not zero
void dyadic::trim() {
    std::uint64_t* const all = limbs();
    while (all[size_ - 1] == 0) --size_;
    if (all[0] != 0) return;
    std::size_t zeros = 1;
    while (all[zeros] == 0) ++zeros;
    std::copy(all + zeros, all + size_, all);
    size_ -= zeros;
    exponent_ += static_cast<int>(zeros);
}

dyadic operator*(const dyadic& a, const dyadic& b) {
    if (a.size_ == 0 || b.size_ == 0) return {};
    dyadic result(a.size_ + b.size_, a.exponent_ + b.exponent_, a.negative_ != b.negative_);
    const std::uint64_t* const p = a.limbs();
    const std::uint64_t* const q = b.limbs();
    std::uint64_t* const to = result.limbs();
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
        const uint128 t = uint128{p[i]} * q[0] + carry;
        to[i] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
    }
    to[a.size_] = carry;
    for (std::size_t j = 1; j < b.size_; ++j) {
        carry = 0;
        for (std::size_t i = 0; i < a.size_; ++i) {
            const uint128 t = uint128{p[i]} * q[j] + to[i + j] + carry;
            to[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        to[j + a.size_] = carry;
    }
    result.trim();
    return result;
}

namespace {

int bits_of(const dyadic& a) {
    return 64 * static_cast<int>(a.size()) - std::countl_zero(a.limbs()[a.size() - 1]);
}

/// The limbs of `a` times 2^shift, in `size` limbs. \pre shift >= 0, and they fit
std::vector<std::uint64_t> shifted(const dyadic& a, int shift, std::size_t size) {
    std::vector<std::uint64_t> result(size);
    const auto whole = static_cast<std::size_t>(shift) / 64;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const uint128 spread = uint128{a.limbs()[i]} << (shift & 63);
        result[whole + i] |= static_cast<std::uint64_t>(spread);
        if (whole + i + 1 < size) result[whole + i + 1] = static_cast<std::uint64_t>(spread >> 64);
    }
    return result;
}

struct digit {
    std::uint64_t value;
    bool remainder;  ///< there is one
};

/// floor(a / b). a has one limb more than b, and a / b is below 2^63.
/// \pre the highest bit of b is set
/// \source Knuth, The Art of Computer Programming 2, section 4.3.1, algorithm D: the quotient of
///         the leading limbs is too large by two at most
digit divided(std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
    const std::size_t size = b.size();
    const uint128 leading = uint128{a[size]} << 64 | a[size - 1];
    auto guess = static_cast<std::uint64_t>(leading / b[size - 1]);
    std::uint64_t carry = 0;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const uint128 product = uint128{guess} * b[i] + carry;
        carry = static_cast<std::uint64_t>(product >> 64);
        const uint128 t = uint128{a[i]} - static_cast<std::uint64_t>(product) - borrow;
        a[i] = static_cast<std::uint64_t>(t);
        borrow = static_cast<std::uint64_t>(t >> 64) & 1;
    }
    a[size] -= carry + borrow;
    while (static_cast<std::int64_t>(a[size]) < 0) {
        --guess;
        std::uint64_t over = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const uint128 t = uint128{a[i]} + b[i] + over;
            a[i] = static_cast<std::uint64_t>(t);
            over = static_cast<std::uint64_t>(t >> 64);
        }
        a[size] += over;
    }
    return {guess, std::any_of(a.begin(), a.end(), [](std::uint64_t x) { return x != 0; })};
}

/// magnitude 2^lowest, of up to 53 bits, as the bits of a double.
/// \pre a double has that value
double assembled(std::uint64_t magnitude, int lowest, bool negative) {
    if (magnitude == 0) return 0.0;
    const int field = std::max(1, lowest + static_cast<int>(std::bit_width(magnitude)) + 1022);
    const int up = lowest + 1075 - field;  // from a multiple of 2^lowest to one of the field's unit
    const std::uint64_t aligned = up >= 0 ? magnitude << up : magnitude >> -up;
    const std::uint64_t sign = std::uint64_t{negative} << 63;
    // The leading bit of a normal number is not stored: it adds one to the field.
    return std::bit_cast<double>(sign | ((static_cast<std::uint64_t>(field - 1) << 52) + aligned));
}

/// (q + f) 2^lowest for a fraction f in [0, 1), which is zero unless `more`, rounded.
/// \pre q in [2^61, 2^63)
rounded_quotient rounded_digit(digit q, int lowest, bool negative, const float_format& format) {
    const int width = static_cast<int>(std::bit_width(q.value));
    const int unit = std::max(lowest + width - format.precision, format.least);
    const int dropped = unit - lowest;
    if (dropped >= 64) return {0.0, false};  // below half of the least
    const std::uint64_t rest = q.value & ((std::uint64_t{1} << dropped) - 1);
    const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
    std::uint64_t kept = q.value >> dropped;
    const bool exact = rest == 0 && !q.remainder;
    kept += rest > half || (rest == half && (q.remainder || (kept & 1) != 0));
    if (unit + static_cast<int>(std::bit_width(kept)) > format.beyond) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {negative ? -infinity : infinity, false};
    }
    return {assembled(kept, unit, negative), exact};
}

}  // namespace

rounded_quotient quotient(const dyadic& a, const dyadic& b, int shift, const float_format& format) {
    assert(b.sign() != 0);
    if (a.sign() == 0) return {0.0, true};
    // b to `size` limbs with the highest bit set, a to 64 size + 62 bits: their quotient is between
    // 2^61 and 2^63, a digit that holds more than any format.
    const std::size_t size = std::max(a.size(), b.size());
    const int bits = 64 * static_cast<int>(size);
    const int up_a = bits + 62 - bits_of(a);
    const int up_b = bits - bits_of(b);
    auto dividend = shifted(a, up_a, size + 1);
    const digit q = divided(dividend, shifted(b, up_b, size));
    const int lowest = up_b - up_a + 64 * (a.exponent() - b.exponent()) + shift;
    return rounded_digit(q, lowest, a.sign() != b.sign(), format);
}

}  // namespace treeform::detail::exact
