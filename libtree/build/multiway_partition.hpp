#pragma once
/// \file
/// Several rounds of halving in one pass over the records.

#include <libtree/build/classify_records.hpp>

namespace treeform::detail {

/// Executes rounds `part.round` ... `part.round + partition_rounds - 1` of `plan` on the records of
/// `part`, in parallel: from `from` to `to`, which both point to the first record of the part.
///
/// A sample of the records is halved in the same way, which gives each node of the next rounds an
/// axis and a bracket of keys. A record descends until it falls into a bracket, so most records
/// reach their part in one pass. The records in brackets, about an eighth, are then distributed
/// from the top down, by selection, so that every part gets its exact number.
///
/// \pre    `plan` has at least `partition_rounds` rounds left
/// \cost   O(count) expected; a bracket that misses its cut costs another pass, at most one for
///         each node
/// \same   on any number of threads
/// \source the sieve of Men, Shen, Gu and Sun, Parallel kd-tree with Batch Updates, SIGMOD 2025,
///         made exact by brackets as in Floyd and Rivest, CACM 18 (1975)
void multiway_partition(const split_record* from, split_record* to, const split_plan& plan,
                        const split_part& part);

}  // namespace treeform::detail
