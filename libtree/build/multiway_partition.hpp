#pragma once
/// \file
/// Several rounds of halving in one pass over the records.

#include <libtree/build/classify_records.hpp>

namespace treeform::detail {

/// Does rounds `part.round` ... `part.round + partition_rounds - 1` of `plan` on the records of
/// `part`, by all threads: from `from` to `to`, both of which begin where the part does.
///
/// A sample of the records is halved as they would be, which gives each node of the next rounds an
/// axis and a bracket of keys. A record goes down until it is in a bracket, so nearly all of them
/// find their place in one pass; those in the brackets, an eighth or so, are then told apart from
/// the top down, by selection, so that every part gets its exact number.
///
/// \pre    `plan` has so many rounds left
/// \cost   O(count) expected; a bracket that misses its cut costs another pass, at most one a node
/// \same   on any number of threads
/// \source the sieve of Men, Shen, Gu and Sun, Parallel kd-tree with Batch Updates, SIGMOD 2025,
///         made exact by brackets as in Floyd and Rivest, CACM 18 (1975)
void multiway_partition(const split_record* from, split_record* to, const split_plan& plan,
                        const split_part& part);

}  // namespace treeform::detail
