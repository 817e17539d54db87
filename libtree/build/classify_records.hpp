#pragma once
/// \file
/// Classifies records by several rounds of brackets at once: the inner loop of the sieve.

#include <treeform/tree/detail/split.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// Number of rounds in one pass of the sieve. Odd: a pass moves records to the other array, as an
/// odd number of single rounds would.
inline constexpr unsigned partition_rounds = 5;

/// The brackets of the nodes of `partition_rounds` rounds, numbered as in a heap: 1 is the part
/// itself, 2n and 2n + 1 are the halves of n. Records below lo[n] on axis[n] go left, those above
/// hi[n] go right, the others are caught by node n. Numbers from `first_bucket` on are the parts
/// after the last round.
struct partition_gates {
    static constexpr std::size_t first_bucket = std::size_t{1} << partition_rounds;
    static constexpr std::size_t numbers = 2 * first_bucket;
    static_assert(partition_rounds % 2 == 1 && numbers <= 256, "numbers are kept as bytes");

    float lo[first_bucket];
    float hi[first_bucket];
    std::int32_t axis[first_bucket];
};

/// Writes, for each record, the number of the node that catches it, or of its bucket.
void classify_records(const partition_gates& gates, const split_record* records, std::size_t count,
                      std::uint8_t* numbers);

}  // namespace treeform::detail
