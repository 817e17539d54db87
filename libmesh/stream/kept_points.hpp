#pragma once
/// \file
/// The set of kept points of a cloud, as a bit array.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::stream {

/// Initially, all points are kept.
class kept_points {
  public:
    /// For `count` points, numbered from `first`.
    explicit kept_points(std::uint64_t count, std::uint64_t first = 0)
        : first_(first), dropped_(count / 64 + 1, 0) {}

    /// Drops a point; returns false if it was already dropped.
    bool drop(std::uint64_t point) {
        point -= first_;
        std::uint64_t& word = dropped_[point / 64];
        const std::uint64_t bit = std::uint64_t{1} << point % 64;
        const bool was_kept = (word & bit) == 0;
        word |= bit;
        return was_kept;
    }
    void keep(std::uint64_t point) {
        point -= first_;
        dropped_[point / 64] &= ~(std::uint64_t{1} << point % 64);
    }
    [[nodiscard]] bool keeps(std::uint64_t point) const {
        point -= first_;
        return (dropped_[point / 64] >> point % 64 & 1) == 0;
    }
    [[nodiscard]] std::uint64_t dropped() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : dropped_) sum += count_ones(word);
        return sum;
    }

    /// Whether some point is dropped in both sets. \pre both have the same count
    [[nodiscard]] bool shares_a_drop(const kept_points& other) const {
        for (std::size_t w = 0; w < dropped_.size(); ++w)
            if ((dropped_[w] & other.dropped_[w]) != 0) return true;
        return false;
    }

    /// Prepares `number_of` for the present set.
    void number() {
        dropped_before_.clear();
        dropped_before_.reserve(dropped_.size() / words_a_step + 1);
        std::uint64_t sum = 0;
        for (std::size_t w = 0; w < dropped_.size(); ++w) {
            if (w % words_a_step == 0) dropped_before_.push_back(sum);
            sum += count_ones(dropped_[w]);
        }
    }
    /// The number of kept points from `first` up to `point`, exclusive.
    [[nodiscard]] std::uint64_t number_of(std::uint64_t point) const {
        point -= first_;
        const std::size_t last = point / 64;
        std::uint64_t sum = dropped_before_[last / words_a_step];
        for (std::size_t w = last / words_a_step * words_a_step; w < last; ++w)
            sum += count_ones(dropped_[w]);
        sum += count_ones(dropped_[last] & ((std::uint64_t{1} << point % 64) - 1));
        return point - sum;
    }

  private:
    static constexpr std::size_t words_a_step = 8;

    [[nodiscard]] static std::uint64_t count_ones(std::uint64_t word) {
        return static_cast<std::uint64_t>(std::popcount(word));
    }

    std::uint64_t first_;
    std::vector<std::uint64_t> dropped_;
    std::vector<std::uint64_t> dropped_before_{};
};

}  // namespace treeform::detail::stream
