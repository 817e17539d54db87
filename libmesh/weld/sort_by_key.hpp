#pragma once
/// \file
/// Parallel bucket sort of small records by a key whose leading bits distribute them evenly.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// Keys have `coarse` + `fine` bits. A bucket has the records with equal coarse bits: about 2^12,
/// which fit into the L2 cache while they are sorted. There are about as many possible keys as
/// records.
struct key_bits {
    int coarse = 0;
    int fine = 0;

    key_bits() = default;
    explicit key_bits(std::size_t records)
        : coarse(std::clamp(static_cast<int>(std::bit_width(records)) - 12, 0, 12)),
          fine(std::clamp(static_cast<int>(std::bit_width(records)) - coarse, 1, 16)) {}

    [[nodiscard]] int all() const { return coarse + fine; }
    [[nodiscard]] std::size_t buckets() const { return std::size_t{1} << coarse; }
};

/// Records by bucket: bucket b has `size[b]` records from `begin[b]` on.
template <class Record>
struct sorted_records {
    buffer<Record> records;
    std::vector<std::size_t> begin;  ///< [buckets + 1]
    std::vector<std::size_t> size;   ///< [buckets]

    [[nodiscard]] std::span<Record> bucket(std::size_t b) {
        return {records.data() + begin[b], size[b]};
    }
    [[nodiscard]] std::span<const Record> bucket(std::size_t b) const {
        return {records.data() + begin[b], size[b]};
    }
};

/// Distributes records to their buckets. `make(i, record)`, for i in [0, count), fills in a record
/// and returns true, or returns false for none. It is called twice for each i, from several
/// threads.
template <class Record, class Make, class KeyOf>
[[nodiscard]] sorted_records<Record> distribute(std::size_t count, const key_bits& bits,
                                                const Make& make, const KeyOf& key_of) {
    // At most 65 chunks: the counts are a table of chunks x buckets.
    const std::size_t grain = std::max(std::size_t{1} << 16, count / 64);
    const std::size_t chunks = chunk_count(count, grain);
    const std::size_t buckets = bits.buckets();
    std::vector<std::size_t> next(chunks * buckets, 0);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t* const size = next.data() + c * buckets;
        Record record;
        for (std::size_t i = begin; i < end; ++i)
            if (make(i, record)) ++size[key_of(record) >> bits.fine];
    });
    sorted_records<Record> sorted;
    sorted.begin.reserve(buckets + 1);
    std::size_t total = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        sorted.begin.push_back(total);
        for (std::size_t c = 0; c < chunks; ++c) {
            const std::size_t size = next[c * buckets + b];
            next[c * buckets + b] = total;
            total += size;
        }
    }
    sorted.begin.push_back(total);
    sorted.size.resize(buckets);
    for (std::size_t b = 0; b < buckets; ++b)
        sorted.size[b] = sorted.begin[b + 1] - sorted.begin[b];
    sorted.records.resize(total);
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t* const at = next.data() + c * buckets;
        Record record;
        for (std::size_t i = begin; i < end; ++i)
            if (make(i, record)) sorted.records[at[key_of(record) >> bits.fine]++] = record;
    });
    return sorted;
}

/// Sorts every bucket by key, and records with equal keys by `less`. Then calls `finish(b, bucket)`
/// for each bucket, which returns its new size, at most the old one.
template <class Record, class KeyOf, class Less, class Finish>
void sort_buckets(sorted_records<Record>& sorted, const key_bits& bits, const KeyOf& key_of,
                  const Less& less, const Finish& finish) {
    constexpr std::size_t per_chunk = 16;
    constexpr std::size_t few = 16;
    const std::size_t keys = std::size_t{1} << bits.fine;
    const auto fine_key = [&](const Record& r) { return key_of(r) & (keys - 1); };
    for_chunks(bits.buckets(), per_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<std::uint32_t> next(keys + 1);
        buffer<Record> scratch;
        for (std::size_t b = begin; b < end; ++b) {
            const std::span<Record> bucket = sorted.bucket(b);
            if (bucket.size() <= few) {
                std::sort(bucket.begin(), bucket.end(), [&](const Record& x, const Record& y) {
                    const auto key_x = key_of(x), key_y = key_of(y);
                    return key_x != key_y ? key_x < key_y : less(x, y);
                });
                sorted.size[b] = finish(b, bucket);
                continue;
            }
            std::fill(next.begin(), next.end(), 0U);
            for (const Record& r : bucket) ++next[fine_key(r) + 1];
            for (std::size_t k = 0; k < keys; ++k) next[k + 1] += next[k];
            scratch.resize(bucket.size());
            std::copy(bucket.begin(), bucket.end(), scratch.data());
            for (const Record& r : scratch.span()) bucket[next[fine_key(r)]++] = r;
            // next[k] is the end of key k now
            std::uint32_t first = 0;
            for (std::size_t k = 0; k < keys; ++k) {
                const std::uint32_t last = next[k];
                if (last - first > few) {
                    std::sort(bucket.begin() + first, bucket.begin() + last, less);
                } else {
                    for (std::uint32_t i = first + 1; i < last; ++i) {
                        const Record moved = bucket[i];
                        std::uint32_t j = i;
                        for (; j > first && less(moved, bucket[j - 1]); --j)
                            bucket[j] = bucket[j - 1];
                        bucket[j] = moved;
                    }
                }
                first = last;
            }
            sorted.size[b] = finish(b, bucket);
        }
    });
}

}  // namespace treeform::detail::weld
