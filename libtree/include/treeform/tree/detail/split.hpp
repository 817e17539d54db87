#pragma once
/// \file
/// Halves a set of primitives by the positions of their centers: the inner loop of the build.

#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// A primitive, and the center of its box in the frame of the tree. Coordinates are finite; in the
/// plane the third is 0, and is never split. Sixteen bytes: one vector register.
struct split_record {
    float center[3];
    std::uint32_t id;
};

/// The plan by which the places of a packed tree are halved recursively, down to its leaf blocks.
///
/// Nodes are cut between children, in rounds, until each part is one child, whose own rounds
/// follow. The root needs ceil(log2(children)) rounds, every other node three. A part of a node
/// that is not full may be a single child before the last round; it then waits.
struct split_plan {
    std::size_t size;
    unsigned levels;
    unsigned root_rounds;

    /// \pre as for `tree::reset`
    static split_plan of(std::size_t size, unsigned levels) {
        const std::size_t unit = std::size_t{1} << (3 * (levels - 1));
        const std::size_t children = (size + unit - 1) / unit;
        return {size, levels,
                children > 1 ? static_cast<unsigned>(std::bit_width(children - 1)) : 0};
    }

    [[nodiscard]] unsigned rounds() const {
        return levels == 1 ? 0 : root_rounds + 3 * (levels - 2);
    }
    /// Number of records of a full child of the nodes that are cut in round `round`.
    [[nodiscard]] std::size_t unit(unsigned round) const {
        const unsigned level = round < root_rounds ? 0 : 1 + (round - root_rounds) / 3;
        return std::size_t{1} << (3 * (levels - 1 - level));
    }
    /// How many of the `count` records of a part go left in round `round`; all, if the part waits.
    [[nodiscard]] std::size_t left(std::size_t count, unsigned round) const {
        const std::size_t child = unit(round);
        return count <= child ? count : (count + child - 1) / child / 2 * child;
    }
};

/// The bounding box of a set of centers.
struct center_range {
    float min[3];
    float max[3];

    void include(const center_range& other) {
        for (int k = 0; k < 3; ++k) {
            min[k] = other.min[k] < min[k] ? other.min[k] : min[k];
            max[k] = other.max[k] > max[k] ? other.max[k] : max[k];
        }
    }
};

/// \pre count > 0
[[nodiscard]] center_range range_of(const split_record* records, std::size_t count);

/// An axis and the range of the centers on it.
struct split_axis {
    int axis;
    float min, max;
};

/// The axis along which the centers spread most; the first of equal ones.
[[nodiscard]] inline split_axis widest_axis(const center_range& range) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (range.max[k] - range.min[k] > range.max[axis] - range.min[axis]) axis = k;
    return {axis, range.min[axis], range.max[axis]};
}

/// Moves `count` records from `from` to `to` so that none of the first `left` is beyond any of the
/// others along the axis on which a sample of them spreads most. In small sets this holds up to a
/// thousandth of the range. `from` is overwritten. Which of several records with equal keys go left
/// depends only on their order in `from`.
///
/// \cost O(count) expected, for any order of the records
void split(split_record* from, split_record* to, std::size_t count, std::size_t left);

/// The records [begin, begin + count) before round `round` of halving; in one of two arrays, by the
/// parity of `round`.
struct split_part {
    std::size_t begin;
    std::size_t count;
    unsigned round;
};

/// Sorts a part into leaf blocks, each time along the widest axis. Records move from one array to
/// the other in each round, and are in `even` or `odd` by the parity of `plan.rounds()` at the end.
void split_to_leaves(split_record* even, split_record* odd, const split_plan& plan,
                     const split_part& part);

}  // namespace treeform::detail
