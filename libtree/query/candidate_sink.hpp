#pragma once
/// \file
/// Collects masks of overlapping slots into blocks of candidate pairs.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

using block_visitor = function_ref<bool(const candidate_block&)>;

/// The positions of the set bits of an 8-bit mask, ascending; the rest 0.
struct mask_bits {
    std::array<std::uint8_t, 8> positions;
    std::uint8_t count;
};
inline constexpr auto bits_of_mask = [] {
    std::array<mask_bits, 256> table{};
    for (unsigned mask = 0; mask < 256; ++mask)
        for (unsigned bit = 0; bit < 8; ++bit)
            if ((mask >> bit & 1U) != 0)
                table[mask].positions[table[mask].count++] = static_cast<std::uint8_t>(bit);
    return table;
}();

/// Collects candidates into blocks, and passes full blocks to a visitor.
class candidate_sink {
  public:
    /// A block is full if it has more than `enough` pairs; `enough` is at most `max_candidates` -
    /// 8.
    explicit candidate_sink(block_visitor visit, std::size_t enough = max_candidates - 8)
        : visit_(visit), enough_(enough) {}

    /// Adds the pairs of `first` with `second` + each bit of `mask`.
    void add(std::uint32_t first, std::uint32_t second, unsigned mask) {
        // All eight are written; the count advances by the number of set bits.
        for (unsigned i = 0; i < 8; ++i) {
            first_[count_ + i] = first;
            second_[count_ + i] = second + bits_of_mask[mask].positions[i];
        }
        count_ += bits_of_mask[mask].count;
        if (count_ > enough_) flush();
    }

    void flush() {
        if (count_ != 0 && !stopped_) {
            total_ += count_;
            stopped_ = !visit_({{first_.data(), count_}, {second_.data(), count_}});
        }
        count_ = 0;
    }

    [[nodiscard]] bool stopped() const { return stopped_; }
    /// Number of candidates passed on so far.
    [[nodiscard]] std::uint64_t total() const { return total_; }

  private:
    block_visitor visit_;
    std::size_t enough_;
    std::size_t count_ = 0;
    std::uint64_t total_ = 0;
    bool stopped_ = false;
    std::array<std::uint32_t, max_candidates + 8> first_;
    std::array<std::uint32_t, max_candidates + 8> second_;
};

}  // namespace treeform::detail
