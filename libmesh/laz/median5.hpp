#pragma once
/// \file
/// An approximate running median.

#include <array>
#include <cstdint>

namespace treeform::detail::laz {

/// Five sorted numbers. Each new number replaces the largest or the smallest one. Which of them is
/// replaced switches after a new number on the side of the median that lost one.
class median5 {
  public:
    [[nodiscard]] std::int32_t get() const { return sorted_[2]; }

    void add(std::int32_t x) {
        if (drop_largest_) {
            if (x >= sorted_[2]) drop_largest_ = false;
            int i = 4;
            for (; i > 0 && x < sorted_[at(i - 1)]; --i) sorted_[at(i)] = sorted_[at(i - 1)];
            sorted_[at(i)] = x;
        } else {
            if (x <= sorted_[2]) drop_largest_ = true;
            int i = 0;
            for (; i < 4 && sorted_[at(i + 1)] < x; ++i) sorted_[at(i)] = sorted_[at(i + 1)];
            sorted_[at(i)] = x;
        }
    }

  private:
    [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    std::array<std::int32_t, 5> sorted_{};
    bool drop_largest_ = true;
};

}  // namespace treeform::detail::laz
