#pragma once
/// \file
/// The tree; several trees that are searched as one; and trees that are searched as if their
/// primitives had moved.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/buffer.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace treeform {

/// Eight boxes as a structure of arrays, so that one query box is tested against all of them at
/// once. A slot without a box contains [+inf, -inf], which overlaps nothing.
template <std::size_t D>
struct alignas(64) wide_node {
    static constexpr std::size_t width = 8;
    float min[D][width];
    float max[D][width];
};

/// How tree boxes are stored: a coordinate x of axis k as (x - origin[k]) * scale, rounded outward
/// to float. The box of a primitive also grows by up to 2^-13 of half its extent on each side. With
/// a local origin, boxes stay tight even if the model is far from the origin of its coordinates.
/// The scale, a power of two, keeps tiny and huge models within the range of float.
template <std::size_t D>
struct tree_frame {
    std::array<double, D> origin{};
    double scale = 1.0;
    friend bool operator==(const tree_frame&, const tree_frame&) = default;
};

/// A balanced 8-ary tree of boxes over N primitives, packed: every node is full, except for the
/// last of its level.
///
/// The shape follows from N alone and is not stored. `ids()` is a permutation of the primitives.
/// Leaf block i has the boxes of the primitives at positions 8i ... 8i+7: slot s has the box of
/// ids()[8i + s]. On the levels above, node i holds the boxes of its children, nodes 8i ... 8i+7 of
/// the level below. Level 0 is the root. So node i of level l covers the positions [i *
/// capacity(l), (i + 1) * capacity(l)), up to N, and every level has an eighth of the nodes of the
/// level below it. Memory: 32 bytes a primitive with D = 3, 23 with D = 2, ids included, plus up to
/// one partly filled node for each level. The tree owns its data; copies are deep.
///
/// \source the balanced n-ary layout of Sajovic, Knez and Korez, tf::tree, section III-A, with
///         boxes stored in their parent and no offsets; packed as by Kamel and Faloutsos, On
///         Packing R-trees, CIKM 1993
template <std::size_t D>
class tree {
  public:
    static constexpr std::size_t dimensions = D;
    static constexpr std::size_t width = wide_node<D>::width;

    /// An empty tree, in which searches find nothing. It allocates nothing, and has no nodes before
    /// `reset`.
    tree() = default;

    /// Sets the shape for `size` primitives. Memory is reused; contents are undefined.
    void reset(std::size_t size) {
        assert(size <= max_size);
        size_ = size;
        levels_ = 1;
        while (capacity(0) < size) ++levels_;
        ids_.resize(size);
        nodes_.resize(level_begin(levels_));
    }

    /// Number of primitives, at most `max_size`.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    static constexpr std::size_t max_size = 0xFFFFFFF8;

    /// [N] the primitives in leaf order, as positions in the range over which the tree was built.
    [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_.span(); }
    [[nodiscard]] std::uint32_t* ids_data() { return ids_.data(); }

    /// Number of levels, leaf blocks included; level 0 is the root.
    [[nodiscard]] unsigned levels() const { return levels_; }
    [[nodiscard]] bool is_leaf_level(unsigned level) const { return level + 1 == levels_; }
    /// Number of primitives below a full node of `level`.
    [[nodiscard]] std::size_t capacity(unsigned level) const {
        const unsigned height = levels_ - level;
        assert(height <= 11);  // a full root of 11 levels is more than max_size
        return std::size_t{1} << (3 * height);
    }
    /// Number of nodes of `level`; at least the root, also for a tree built over an empty range.
    [[nodiscard]] std::size_t nodes_in_level(unsigned level) const {
        return level == 0 ? 1 : (size_ + capacity(level) - 1) / capacity(level);
    }
    /// Number of children of node `node` of `level`; on the last level, of its primitives.
    [[nodiscard]] std::size_t child_count(unsigned level, std::size_t node) const {
        const std::size_t below = is_leaf_level(level) ? size_ : nodes_in_level(level + 1);
        return std::min(width, below - width * node);
    }

    [[nodiscard]] std::span<const wide_node<D>> level(unsigned level) const {
        return {nodes_.data() + level_begin(level), nodes_in_level(level)};
    }
    [[nodiscard]] wide_node<D>* level_data(unsigned level) {
        return nodes_.data() + level_begin(level);
    }

    [[nodiscard]] const tree_frame<D>& frame() const { return frame_; }
    void set_frame(const tree_frame<D>& frame) { frame_ = frame; }

  private:
    /// Number of nodes above `level`.
    [[nodiscard]] std::size_t level_begin(unsigned level) const {
        std::size_t begin = 0;
        for (unsigned l = 0; l < level; ++l) begin += nodes_in_level(l);
        return begin;
    }

    std::size_t size_ = 0;
    unsigned levels_ = 1;
    detail::buffer<std::uint32_t> ids_;
    detail::buffer<wide_node<D>> nodes_;
    tree_frame<D> frame_;
};

/// Several trees (parts) that are searched as one. Searches accept them like a `tree`, with the
/// same results as on a tree over all their primitives. Exceptions, which require a `tree`: the
/// searches for pairs in blocks (`search_broad`, `search_self_broad`, `..._chunks`), and
/// `visit_swept`.
///
/// `top()` is a tree over boxes around the parts; its `ids()` are the numbers of parts. `part(n)`
/// is the tree of part n, which may be built at the first call; calls may come from several
/// threads at once. Its `ids()` are primitives of the whole set, each in one part, or 0xFFFFFFFF
/// for an empty slot. The leaf order of the whole is that of the top, then that within each part.
template <class T>
concept tree_of_trees = requires(const T& whole, std::uint32_t number) {
    { whole.size() } -> std::convertible_to<std::size_t>;  // primitives
    { whole.top() } -> std::same_as<const tree<T::dimensions>&>;
    { whole.part(number) } -> std::same_as<const tree<T::dimensions>&>;
};

namespace detail {

/// In `tree::ids()`: an empty slot, whose primitive was removed.
inline constexpr std::uint32_t no_primitive = 0xFFFFFFFF;

template <class T>
inline constexpr bool is_tree = false;
template <std::size_t D>
inline constexpr bool is_tree<tree<D>> = true;

}  // namespace detail

/// Any tree that a search by one query accepts: a `tree`, or a `tree_of_trees`.
template <class T>
concept any_tree = detail::is_tree<T> || tree_of_trees<T>;

/// A tree of any kind that is searched as if an affine map had moved its primitives:
/// `search(transformed{tree, map}, other, ...)`.
///
/// Nothing is rebuilt. Boxes are moved when a search opens their node. Under a translation or a
/// quarter turn, a box keeps its size. Under any other rotation it grows: its sides are at most
/// sqrt(D) times the longest side of the original. A moved box contains the exact images of the
/// primitives, and also the images that `transform::operator()` rounds to double. So no pair is
/// missed, whether you test exact or rounded images.
///
/// \source Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990
template <std::size_t D, class Tree = tree<D>>
class transformed {
  public:
    static constexpr std::size_t dimensions = D;

    /// \pre    `tree` outlives this and every search that takes it
    /// \throws std::invalid_argument if an entry of `by` is NaN or infinite
    transformed(const Tree& tree, const transform<D>& by) : tree_(&tree), by_(by) {
        if (!by.finite())
            throw std::invalid_argument(
                "treeform::transformed: an entry of the transform is not finite");
    }
    /// The tree without a transform.
    transformed(const Tree& tree) : tree_(&tree) {}  // NOLINT: meant to be implicit

    [[nodiscard]] const Tree& original() const { return *tree_; }
    [[nodiscard]] const transform<D>& map() const { return by_; }
    [[nodiscard]] bool is_moved() const { return by_ != transform<D>{}; }

  private:
    const Tree* tree_;
    transform<D> by_;
};

template <any_tree Tree>
transformed(const Tree&) -> transformed<Tree::dimensions, Tree>;
template <any_tree Tree>
transformed(const Tree&, const transform<Tree::dimensions>&) -> transformed<Tree::dimensions, Tree>;

namespace detail {

template <class T>
inline constexpr bool is_transformed = false;
template <std::size_t D, class Tree>
inline constexpr bool is_transformed<transformed<D, Tree>> = true;

}  // namespace detail

/// Either side of a search of two trees that requires a `tree`: a `tree`, or a `transformed` one.
template <class T>
concept tree_or_transformed = detail::is_tree<T> || std::same_as<T, transformed<T::dimensions>>;
static_assert(tree_or_transformed<tree<3>> && tree_or_transformed<transformed<2>>);

/// The same for any kind of tree.
template <class T>
concept any_tree_or_transformed = any_tree<T> || detail::is_transformed<T>;

}  // namespace treeform
