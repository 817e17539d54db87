#pragma once
/// \file
/// The wide tree: the pair <ids, nodes>. Data, no algorithm.

#include <libtree/detail/buffer.hpp>

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tf {

/// Eight boxes side by side, so that one query box is tested against all of them at once. A slot
/// without a box holds [+inf, -inf], which overlaps nothing.
template <std::size_t D>
struct alignas(64) wide_node {
    static constexpr std::size_t width = 8;
    float min[D][width];
    float max[D][width];
};

/// How tree boxes lie in space: a coordinate x of axis k is stored as (x - origin[k]) * scale,
/// rounded outward to float. Boxes about a local origin stay tight however far the model is from
/// the origin of its own coordinates, and a power-of-two scale keeps tiny and huge models away
/// from the ends of the range of float.
template <std::size_t D>
struct tree_frame {
    std::array<double, D> origin{};
    double scale = 1.0;
    friend bool operator==(const tree_frame&, const tree_frame&) = default;
};

/// A balanced 8-ary tree of boxes over N primitives.
///
/// The shape follows from N alone, so it is stored nowhere: `depth` binary splits, the fewest that
/// leave at most 8 primitives a leaf, cut the permutation `ids()` into 2^depth leaf blocks of
/// nearly equal size; three binary levels make one node level, and the root takes what remains.
/// Node i of level l holds the boxes of its children, nodes 8i ... 8i+7 of level l+1 (the root has
/// `root_arity()` children); on the last level, leaf block i holds the boxes of its primitives,
/// those of ids()[leaf_begin(i)] ... ids()[leaf_begin(i+1) - 1].
///
/// \source the balanced n-ary layout of Sajovic, Knez and Korez, tf::tree, section III-A, with
///         boxes stored in their parent and no offsets
template <std::size_t D>
class tree {
  public:
    static constexpr std::size_t dimensions = D;
    static constexpr std::size_t width = wide_node<D>::width;

    /// An empty tree over `size` primitives; `build` fills it.
    tree() = default;

    /// Takes the shape for `size` primitives; memory is reused, contents are not.
    void reset(std::size_t size) {
        assert(size < max_size);
        size_ = size;
        depth_ = 0;
        while ((width << depth_) < size) ++depth_;
        levels_ = (depth_ + 2) / 3 + 1;
        ids_.resize(size);
        nodes_.resize(level_begin(levels_));
    }

    /// Primitives in the tree; a tree holds fewer than 2^32 - 8.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    static constexpr std::size_t max_size = 0xFFFFFFF8;

    /// [N] the primitives in leaf order, by their place in the range the tree was built over.
    [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_.span(); }
    [[nodiscard]] std::uint32_t* ids_data() { return ids_.data(); }

    /// Binary splits from the root to a leaf block.
    [[nodiscard]] unsigned depth() const { return depth_; }
    /// Node levels, leaf blocks included; level 0 is the root.
    [[nodiscard]] unsigned levels() const { return levels_; }
    [[nodiscard]] bool is_leaf_level(unsigned level) const { return level + 1 == levels_; }
    /// Binary splits above level `level`; it has 2^that many nodes.
    [[nodiscard]] unsigned depth_of_level(unsigned level) const {
        return level == 0 ? 0 : depth_ - 3 * (levels_ - 1 - level);
    }
    [[nodiscard]] std::size_t nodes_in_level(unsigned level) const {
        return std::size_t{1} << depth_of_level(level);
    }
    [[nodiscard]] std::size_t root_arity() const { return levels_ > 1 ? nodes_in_level(1) : size_; }

    [[nodiscard]] std::span<const wide_node<D>> level(unsigned level) const {
        return {nodes_.data() + level_begin(level), nodes_in_level(level)};
    }
    [[nodiscard]] wide_node<D>* level_data(unsigned level) {
        return nodes_.data() + level_begin(level);
    }

    /// First place in `ids()` of the primitives below node `node` of a level `binary_depth` splits
    /// down; `node` may be one past the last.
    [[nodiscard]] std::size_t range_begin(std::size_t node, unsigned binary_depth) const {
        return (node * size_) >> binary_depth;
    }
    [[nodiscard]] std::size_t leaf_begin(std::size_t block) const {
        return range_begin(block, depth_);
    }

    [[nodiscard]] const tree_frame<D>& frame() const { return frame_; }
    void set_frame(const tree_frame<D>& frame) { frame_ = frame; }

  private:
    /// Nodes above `level`. The levels between root and leaves are the sum 1 + a + 8a + 64a + ...
    [[nodiscard]] std::size_t level_begin(unsigned level) const {
        std::size_t begin = 0;
        for (unsigned l = 0; l < level; ++l) begin += nodes_in_level(l);
        return begin;
    }

    std::size_t size_ = 0;
    unsigned depth_ = 0;
    unsigned levels_ = 1;
    detail::buffer<std::uint32_t> ids_;
    detail::buffer<wide_node<D>> nodes_;
    tree_frame<D> frame_;
};

}  // namespace tf
