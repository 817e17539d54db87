#pragma once
/// \file
/// How often the predicates were called, and what it took to decide.

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform {

/// Counts of one caller; a thread has its own and the caller adds them up, so nothing is shared.
struct predicate_counters {
    /// Widths of the exact stage: 128-bit words, then 1, 2, 4, 8, 16 and 33 limbs a coordinate.
    static constexpr std::size_t widths = 7;

    std::uint64_t calls = 0;                       ///< predicates asked
    std::uint64_t undecided = 0;                   ///< of these, left open by the filter
    std::array<std::uint64_t, widths> by_width{};  ///< of these, decided exactly at each width

    predicate_counters& operator+=(const predicate_counters& other) {
        calls += other.calls;
        undecided += other.undecided;
        for (std::size_t i = 0; i < widths; ++i) by_width[i] += other.by_width[i];
        return *this;
    }
};

}  // namespace treeform
