#include <libtree/build/multiway_partition.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail {
namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 12;

constexpr std::size_t first_bucket = partition_gates::first_bucket;
constexpr std::size_t numbers = partition_gates::numbers;

template <class T>
using by_number = std::array<T, numbers>;

/// The parts that the next rounds make of a part, and brackets for them from a sample.
class partition_plan {
  public:
    partition_plan(const split_record* from, const split_plan& plan, const split_part& part) {
        parts_[1] = part;
        for (std::size_t n = 1; n < first_bucket; ++n) {
            const auto [begin, count, round] = parts_[n];
            const std::size_t left = plan.left(count, round);
            parts_[2 * n] = {begin, left, round + 1};
            parts_[2 * n + 1] = {begin + left, count - left, round + 1};
        }
        const std::size_t size = std::clamp<std::size_t>(part.count / 32, 1024, 32768);
        std::vector<split_record> sample(size);
        for (std::size_t i = 0; i < size; ++i) sample[i] = from[i * part.count / size];
        by_number<std::span<split_record>> sample_of{};
        sample_of[1] = sample;
        for (std::size_t first = 1; first < first_bucket; first *= 2)
            for_chunks(first, 1, [&](std::size_t i, std::size_t, std::size_t) {
                const std::size_t n = first + i;
                const std::size_t left = set_gate_from(n, sample_of[n]);
                sample_of[2 * n] = sample_of[n].first(left);
                sample_of[2 * n + 1] = sample_of[n].subspan(left);
            });
    }

    [[nodiscard]] const split_part& part(std::size_t n) const { return parts_[n]; }
    [[nodiscard]] const partition_gates& gates() const { return gates_; }

    /// Whether a record goes left (-1) or right (1) from node `n`, or is caught there (0).
    [[nodiscard]] int way(const split_record& record, std::size_t n) const {
        const float key = record.center[gates_.axis[n]];
        return key > gates_.hi[n] ? 1 : key < gates_.lo[n] ? -1 : 0;
    }

    /// Has node `n` catch every record.
    void close(std::size_t n) { set_gate(n, -infinity, infinity, gates_.axis[n]); }

  private:
    /// Returns how many of the sample go left.
    std::size_t set_gate_from(std::size_t n, std::span<split_record> sample) {
        const std::size_t count = parts_[n].count, left = parts_[2 * n].count;
        const std::size_t size = sample.size();
        if (left == count) {  // rests: all go left
            set_gate(n, infinity, infinity, 0);
            return size;
        }
        if (size < 2) {
            set_gate(n, -infinity, infinity, 0);
            return size;
        }
        const int axis = widest_axis(range_of(sample.data(), size)).axis;
        const auto select = [&](std::size_t first, std::size_t nth) {
            std::nth_element(sample.begin() + static_cast<std::ptrdiff_t>(first),
                             sample.begin() + static_cast<std::ptrdiff_t>(nth), sample.end(),
                             [axis](const split_record& a, const split_record& b) {
                                 return a.center[axis] < b.center[axis];
                             });
            return sample[nth].center[axis];
        };
        // Three standard deviations of the rank in the sample, to either side.
        const double share = static_cast<double>(left) / static_cast<double>(count);
        const double expected = share * static_cast<double>(size);
        const double spread = 3.0 * std::sqrt((1.0 - share) * expected) + 1.0;
        const auto lo = static_cast<std::size_t>(std::max(0.0, expected - spread));
        const auto middle = std::max(lo, static_cast<std::size_t>(expected));
        const auto hi = std::clamp(static_cast<std::size_t>(expected + spread), middle, size - 1);
        const float at_lo = select(0, lo);
        const float at_middle = select(lo, std::min(middle, size - 1));
        set_gate(n, at_lo, hi > middle ? select(middle, hi) : at_middle, axis);
        return middle;
    }

    void set_gate(std::size_t n, float lo, float hi, int axis) {
        gates_.lo[n] = lo;
        gates_.hi[n] = hi;
        gates_.axis[n] = axis;
    }

    static constexpr float infinity = std::numeric_limits<float>::infinity();
    by_number<split_part> parts_;
    partition_gates gates_{};
};

/// What has come where so far, by number of the node.
struct partition_state {
    by_number<std::size_t> reached{};             ///< records at the node or below
    by_number<std::vector<split_record>> open{};  ///< records caught there
};

/// Lets a record that has been decided to belong under node `n` go on from there. Returns the
/// number of a node whose bracket let too many pass to one side, or 0.
std::size_t drop(const partition_plan& sieve, const split_record& record, std::size_t n,
                 split_record* to, partition_state& state) {
    for (;;) {
        const split_part& part = sieve.part(n);
        const std::size_t place = state.reached[n]++;
        if (place >= part.count) return n / 2;
        if (n >= first_bucket) {
            to[part.begin - sieve.part(1).begin + place] = record;
            return 0;
        }
        const int way = sieve.way(record, n);
        if (way == 0) {
            state.open[n].push_back(record);
            return 0;
        }
        n = 2 * n + (way > 0 ? 1 : 0);
    }
}

/// Tells the records caught at node `n`, which has been reached by all that belong there, apart.
/// Returns as `drop`.
std::size_t settle(const partition_plan& sieve, std::size_t n, split_record* to,
                   partition_state& state) {
    std::vector<split_record>& open = state.open[n];
    const std::size_t wanted = sieve.part(2 * n).count, have = state.reached[2 * n];
    if (have > wanted || wanted - have > open.size()) return n;
    const std::size_t left = wanted - have;
    if (left > 0 && left < open.size())
        std::nth_element(
            open.begin(), open.begin() + static_cast<std::ptrdiff_t>(left), open.end(),
            [axis = sieve.gates().axis[n]](const split_record& a, const split_record& b) {
                return a.center[axis] < b.center[axis];
            });
    std::size_t misled = 0;
    for (std::size_t i = 0; i < open.size() && misled == 0; ++i)
        misled = drop(sieve, open[i], 2 * n + (i < left ? 0 : 1), to, state);
    open = {};
    return misled;
}

/// The number of a node whose bracket missed the cut; 0 when all is sorted. `from` is as it was.
std::size_t try_partition(const partition_plan& sieve, const split_record* from, split_record* to) {
    const std::size_t count = sieve.part(1).count;

    // How many records of each chunk come where, then where they begin.
    buffer<std::uint8_t> number_of(count);
    std::vector<by_number<std::size_t>> at(chunk_count(count, chunk_size));
    for_chunks(count, chunk_size, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        classify_records(sieve.gates(), from + begin, end - begin, number_of.data() + begin);
        by_number<std::size_t> n{};
        for (std::size_t i = begin; i < end; ++i) ++n[number_of[i]];
        at[chunk] = n;
    });
    partition_state state;
    for (by_number<std::size_t>& n : at)
        for (std::size_t number = 1; number < numbers; ++number)
            state.reached[number] += std::exchange(n[number], state.reached[number]);
    by_number<split_record*> to_of{};
    for (std::size_t n = 1; n < first_bucket; ++n) {
        state.open[n].resize(state.reached[n]);
        to_of[n] = state.open[n].data();
    }
    for (std::size_t n = first_bucket; n < numbers; ++n)
        to_of[n] = to + (sieve.part(n).begin - sieve.part(1).begin);
    for (std::size_t n = first_bucket; n-- > 1;)
        state.reached[n] += state.reached[2 * n] + state.reached[2 * n + 1];
    for (std::size_t n = 2; n < numbers; ++n)
        if (state.reached[n] > sieve.part(n).count) return n / 2;

    for_chunks(count, chunk_size, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        by_number<split_record*> next = to_of;
        for (std::size_t number = 1; number < numbers; ++number) next[number] += at[chunk][number];
        for (std::size_t i = begin; i < end; ++i) *next[number_of[i]]++ = from[i];
    });

    for (std::size_t first = 1; first < first_bucket; first *= 2) {  // nodes of a round: disjoint
        by_number<std::size_t> misled{};
        for_chunks(first, 1, [&](std::size_t i, std::size_t, std::size_t) {
            misled[i] = settle(sieve, first + i, to, state);
        });
        for (std::size_t i = 0; i < first; ++i)
            if (misled[i] != 0) return misled[i];
    }
    return 0;
}

}  // namespace

void multiway_partition(const split_record* from, split_record* to, const split_plan& plan,
                        const split_part& part) {
    partition_plan brackets(from, plan, part);
    // A bracket that misled is given up: its node, at worst every node, tells by selection alone.
    while (const std::size_t misled = try_partition(brackets, from, to)) brackets.close(misled);
}

}  // namespace treeform::detail
