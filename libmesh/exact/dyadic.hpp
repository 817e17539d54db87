#pragma once
/// \file
/// Numbers m 2^(64 e) of any size, for values without a fixed width that is known to suffice.

#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace treeform::detail::exact {

/// An exact number: an integer multiple of a power of two. Sums and products are exact and never
/// overflow. Values made from finite doubles use no heap memory below 1536 bits.
class TREEFORM_API dyadic {
  public:
    /// Zero.
    dyadic() = default;
    /// `magnitude` 2^shift, or its negative.
    dyadic(std::uint64_t magnitude, bool negative, int shift);
    /// The integer with these limbs, lowest first, or its negative.
    dyadic(std::span<const std::uint64_t> magnitude, bool negative);
    /// The value of a finite double, including denormals. Uses bit operations only.
    explicit dyadic(double x);

    dyadic(const dyadic& other);
    dyadic(dyadic&& other) noexcept;
    dyadic& operator=(const dyadic&) = delete;
    ~dyadic() = default;

    /// -1, 0 or +1.
    [[nodiscard]] int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
    /// The limbs of the magnitude, lowest first; neither the first nor the last is zero.
    [[nodiscard]] const std::uint64_t* limbs() const { return heap_ ? heap_.get() : near_.data(); }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// The weight of the lowest limb is 2^(64 exponent).
    [[nodiscard]] int exponent() const { return exponent_; }

    friend dyadic operator+(const dyadic& a, const dyadic& b) { return dyadic(a, b, b.negative_); }
    friend dyadic operator-(const dyadic& a, const dyadic& b) { return dyadic(a, b, !b.negative_); }
    friend TREEFORM_API dyadic operator*(const dyadic& a, const dyadic& b);

  private:
    static constexpr std::size_t near_limbs = 24;

    /// Allocates `size` limbs, uninitialized.
    dyadic(std::size_t size, int exponent, bool negative);
    /// a + |b|, or a - |b| if `b_negative`; the sign of b is ignored.
    dyadic(const dyadic& a, const dyadic& b, bool b_negative);

    [[nodiscard]] std::uint64_t* limbs() { return heap_ ? heap_.get() : near_.data(); }
    void reserve(std::size_t size);
    void assign(const dyadic& other);
    void assign_sum(const dyadic& a, const dyadic& b);
    void assign_difference(const dyadic& larger, const dyadic& smaller);
    void place(const dyadic& other);
    void trim();

    std::size_t size_ = 0;  ///< 0 for zero
    int exponent_ = 0;
    bool negative_ = false;
    std::unique_ptr<std::uint64_t[]> heap_;
    std::array<std::uint64_t, near_limbs> near_;  // only `size_` of them are ever set
};

[[nodiscard]] inline int sign_of(const dyadic& a) { return a.sign(); }

/// A binary floating-point format: its bits of precision, the exponent of its least denormal, and
/// the exponent of the least power of two beyond its range.
struct float_format {
    int precision;
    int least;
    int beyond;
};
inline constexpr float_format double_format{53, -1074, 1024};
inline constexpr float_format float_format_32{24, -149, 128};

struct rounded_quotient {
    double value;  ///< infinite on overflow; never -0
    bool exact;    ///< the value equals the quotient
};

/// (a / b) 2^shift, rounded once to the nearest number of the format, ties to even.
/// \pre b != 0; every number of `format` is a double
[[nodiscard]] TREEFORM_API rounded_quotient quotient(const dyadic& a, const dyadic& b, int shift,
                                                     const float_format& format);

}  // namespace treeform::detail::exact
