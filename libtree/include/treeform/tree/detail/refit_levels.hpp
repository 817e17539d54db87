#pragma once
/// \file
/// The compiled half of a refit: new boxes into leaf slots, and what follows from them above.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/round_boxes.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail {

/// Some slots of a leaf block, a bit each.
struct leaf_slots {
    std::uint32_t block;
    std::uint8_t slots;
};

/// The slots at `places`, by block, ascending; a place that is named twice counts once.
/// \pre  every place is below `size`
/// \cost O(P log P) for few of P places, O(P + size / 8) for many
[[nodiscard]] TREEFORM_API std::vector<leaf_slots> slots_at(std::span<const std::uint32_t> places,
                                                            std::size_t size);

/// Writes boxes into leaf slots, box j at place `places[j]`, rounded outward as a build does.
/// Returns how many precede the first that is empty or not finite; it and those behind it stay.
template <std::size_t D>
[[nodiscard]] TREEFORM_API std::size_t write_boxes(tree<D>& tree, const box_block<D>& boxes,
                                                   std::span<const std::uint32_t> places);

/// Corrects the levels above those that hold the boxes of leaf blocks: all of them, or what is
/// above the blocks that have changed.
template <std::size_t D>
TREEFORM_API void lift_inner(tree<D>& tree);
template <std::size_t D>
TREEFORM_API void lift_inner(tree<D>& tree, std::span<const leaf_slots> changed);

/// Gathers boxes with their places and writes them a block at a time.
template <std::size_t D>
class slot_writer {
  public:
    explicit slot_writer(tree<D>& tree) : tree_(&tree) {}

    /// False when a box that was given is empty or not finite; no more are written from there on.
    template <class Box>
    bool put(std::uint32_t place, const Box& box) {
        boxes_.set(count_, box);
        places_[count_++] = place;
        return count_ < box_block<D>::size || flush();
    }
    bool flush() {
        const std::size_t count = std::exchange(count_, 0);
        written_ = write_boxes<D>(*tree_, boxes_, std::span(places_).first(count));
        return written_ == count;
    }
    /// The place of the box at which a call returned false.
    [[nodiscard]] std::uint32_t bad_place() const { return places_[written_]; }

  private:
    tree<D>* tree_;
    std::size_t count_ = 0;
    std::size_t written_ = 0;
    box_block<D> boxes_;
    std::array<std::uint32_t, box_block<D>::size> places_;
};

}  // namespace treeform::detail
