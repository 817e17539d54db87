#pragma once
/// \file
/// The compiled half of a refit: writes new boxes into leaf slots, and updates the levels above.

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

/// A set of slots of a leaf block, as a bit mask.
struct leaf_slots {
    std::uint32_t block;
    std::uint8_t slots;
};

/// The slots at `places`, grouped by block, ascending; repeated places count once.
/// \pre  every place is below `size`
/// \cost for P places: O(P log P) if P is small compared with `size`, else O(P + size / 8)
[[nodiscard]] TREEFORM_API std::vector<leaf_slots> slots_at(std::span<const std::uint32_t> places,
                                                            std::size_t size);

/// Writes boxes into leaf slots, box j at place `places[j]`, rounded outward as a build does.
/// Returns the number of boxes before the first that is empty or not finite; from there on nothing
/// is written.
template <std::size_t D>
[[nodiscard]] TREEFORM_API std::size_t write_boxes(tree<D>& tree, const box_block<D>& boxes,
                                                   std::span<const std::uint32_t> places);

/// Updates the levels above the parents of leaf blocks: all of them, or only the ancestors of the
/// changed blocks.
template <std::size_t D>
TREEFORM_API void lift_inner(tree<D>& tree);
template <std::size_t D>
TREEFORM_API void lift_inner(tree<D>& tree, std::span<const leaf_slots> changed);

/// Collects boxes with their places, and writes them block by block.
template <std::size_t D>
class slot_writer {
  public:
    explicit slot_writer(tree<D>& tree) : tree_(&tree) {}

    /// Returns false if a box passed so far is empty or not finite; from there on nothing is
    /// written.
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
