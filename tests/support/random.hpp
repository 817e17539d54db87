#pragma once
/// \file
/// Numbers for tests, the same on every machine: the engine's bits, no standard distribution.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace test {

class random {
  public:
    explicit random(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t bits() { return engine_(); }
    /// In [0, count).
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
    /// In [0, 1), a multiple of 2^-53.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double in(double low, double high) { return low + (high - low) * unit(); }

    template <class T>
    void shuffle(std::vector<T>& values) {
        for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace test
