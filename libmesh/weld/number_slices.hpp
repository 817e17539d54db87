#pragma once
/// \file
/// The points of a cloud by their numbers, cut into slices: all of one come before those of the next.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::detail::weld {

/// Slices of equal size; one of all numbers, unless said otherwise.
class number_slices {
  public:
    static constexpr std::size_t most = 64;

    number_slices() = default;
    /// At most 64 slices of the numbers below `count`.
    explicit number_slices(std::uint64_t count) : numbers_a_slice_(count / most + 1) {}

    [[nodiscard]] std::size_t of(std::uint64_t number) const {
        return static_cast<std::size_t>(number / numbers_a_slice_);
    }
    /// One of a set, whose bit is set.
    [[nodiscard]] std::uint64_t bit_of(std::uint64_t number) const {
        return std::uint64_t{1} << of(number);
    }
    [[nodiscard]] static bool has(std::uint64_t set, std::size_t slice) {
        return (set >> slice & 1) != 0;
    }
    /// Those of a set that come after a slice.
    [[nodiscard]] static std::uint64_t after(std::size_t slice, std::uint64_t set) {
        return set >> slice >> 1 << slice << 1;
    }

  private:
    std::uint64_t numbers_a_slice_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace treeform::detail::weld
