#pragma once
/// \file
/// Random numbers that every standard library makes alike.

#include <cstdint>
#include <random>

namespace treeform::test {

class random_source {
  public:
    explicit random_source(std::uint64_t seed) : engine_(seed) {}

    /// 0 to n - 1, n > 0. Off from uniform by less than n / 2^64.
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    /// A multiple of 2^-53 in [0, 1).
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    /// A whole number from low to high.
    double whole(int low, int high) {
        return static_cast<double>(
            low + static_cast<int>(below(static_cast<std::uint64_t>(high - low + 1))));
    }
    bool one_in(std::uint64_t n) { return below(n) == 0; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace treeform::test
