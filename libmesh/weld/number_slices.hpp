#pragma once
/// \file
/// Divides the point numbers of a cloud into slices: consecutive ranges of numbers.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::weld {

/// Slices of equal size; consecutive slices form bundles. By default, one slice has all numbers. A
/// set of bundles is an integer with one bit for each bundle.
class number_slices {
  public:
    static constexpr std::size_t bundles = 64;
    /// Smaller slices save little memory, and more points have neighbors in other slices.
    static constexpr unsigned bits_of_slice = 15;

    number_slices() = default;
    /// Divides the numbers below `count` into at most 64 bundles. A bundle of more than `1 <<
    /// least_bits` numbers is divided into slices of at least that many; there are at most 1024
    /// slices.
    explicit number_slices(std::uint64_t count, unsigned least_bits = bits_of_slice)
        : bundle_bits_(bits_for(count, 6)),
          slice_bits_(std::min(bundle_bits_, std::max(least_bits, bits_for(count, 10)))) {}

    [[nodiscard]] std::uint64_t slice_of(std::uint64_t number) const {
        return number >> slice_bits_;
    }
    [[nodiscard]] std::size_t bundle_of(std::uint64_t number) const {
        return static_cast<std::size_t>(number >> bundle_bits_);
    }
    /// The first number of a slice; `bundle_begin`: of a bundle.
    [[nodiscard]] std::uint64_t slice_begin(std::uint64_t slice) const {
        return slice << slice_bits_;
    }
    [[nodiscard]] std::uint64_t bundle_begin(std::uint64_t bundle) const {
        return bundle << bundle_bits_;
    }

    /// The set with the bundle of `number` only.
    [[nodiscard]] std::uint64_t bit_of(std::uint64_t number) const {
        return std::uint64_t{1} << bundle_of(number);
    }
    [[nodiscard]] static bool has(std::uint64_t set, std::size_t bundle) {
        return (set >> bundle & 1) != 0;
    }
    /// The bundles in `set` that have a slice after the first slice of `bundle`.
    [[nodiscard]] std::uint64_t after(std::size_t bundle, std::uint64_t set) const {
        return bundle_bits_ > slice_bits_ ? set >> bundle << bundle
                                          : set >> bundle >> 1 << bundle << 1;
    }
    /// The bundles in `set` that have a slice at or after `number`, which is the first number of a
    /// slice.
    [[nodiscard]] std::uint64_t from(std::uint64_t number, std::uint64_t set) const {
        const std::size_t bundle = bundle_of(number);
        return bundle < bundles ? set >> bundle << bundle : 0;
    }

  private:
    /// Bits of a number within a part, for at most `1 << part_bits` parts.
    [[nodiscard]] static unsigned bits_for(std::uint64_t count, unsigned part_bits) {
        return static_cast<unsigned>(
            std::bit_width((std::max<std::uint64_t>(count, 1) - 1) >> part_bits));
    }

    unsigned bundle_bits_ = 63;
    unsigned slice_bits_ = 63;
};

}  // namespace treeform::detail::weld
