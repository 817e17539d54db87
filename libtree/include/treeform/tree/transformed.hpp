#pragma once
/// \file
/// A tree as if its primitives had been moved, without a rebuild.

#include <treeform/tree/transform.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <stdexcept>

namespace treeform {

/// A tree whose contents count as moved by an affine map: `search(transformed{tree, map}, other,
/// ...)`. Boxes are moved when a search opens their node, and grow by the turning of boxes: not for
/// a translation or a quarter turn; under another rotation, to at most sqrt(D) times their longest
/// side in each direction.
///
/// The moved boxes hold the exact images of the primitives, and also the images that
/// `transform::operator()` rounds to double; so both those who decide on exact images and those
/// who decide on rounded ones miss no pair.
///
/// \source Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990
template <std::size_t D>
class transformed {
  public:
    static constexpr std::size_t dimensions = D;

    /// \pre    `tree` outlives this and every search that takes it
    /// \throws std::invalid_argument when an entry of `by` is NaN or infinite
    transformed(const tree<D>& tree, const transform<D>& by) : tree_(&tree), by_(by) {
        if (!by.finite())
            throw std::invalid_argument("treeform::transformed: an entry of the map is not finite");
    }
    /// A tree as it is.
    transformed(const tree<D>& tree) : tree_(&tree) {}  // NOLINT: meant to be implicit

    [[nodiscard]] const tree<D>& original() const { return *tree_; }
    [[nodiscard]] const transform<D>& by() const { return by_; }
    [[nodiscard]] bool moves() const { return by_ != transform<D>{}; }

  private:
    const tree<D>* tree_;
    transform<D> by_;
};

namespace detail {

template <class T>
inline constexpr bool is_placed_tree = false;
template <std::size_t D>
inline constexpr bool is_placed_tree<tree<D>> = true;
template <std::size_t D>
inline constexpr bool is_placed_tree<transformed<D>> = true;

}  // namespace detail

/// What a search of two trees takes on either side: a tree, or one that counts as moved.
template <class T>
concept placed_tree = detail::is_placed_tree<T>;
static_assert(placed_tree<tree<3>> && placed_tree<transformed<2>>);

}  // namespace treeform
