#pragma once
/// \file
/// Rounds boxes outward into the frame of a tree: the first pass of a build.

#include <treeform/tree/detail/build_records.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// A block of boxes, as a structure of arrays.
template <std::size_t D>
struct box_block {
    static constexpr std::size_t size = 256;  ///< a multiple of the lanes of any vector
    alignas(64) double min[D][size];
    alignas(64) double max[D][size];

    template <class Box>
    void set(std::size_t i, const Box& box) {
        for (std::size_t k = 0; k < D; ++k) {
            min[k][i] = static_cast<double>(box.min[k]);
            max[k][i] = static_cast<double>(box.max[k]);
        }
    }
};

/// Writes the records and half extents of the elements first_id ... first_id + count - 1, whose
/// boxes are the first `count` of `boxes`. Returns the number of boxes before the first that is
/// empty or not finite; `count` if all are valid.
template <std::size_t D>
[[nodiscard]] TREEFORM_API std::size_t round_boxes(const tree_frame<D>& frame,
                                                   const box_block<D>& boxes, std::size_t count,
                                                   std::uint32_t first_id, split_record* records,
                                                   half_extents* extents);

extern template TREEFORM_API std::size_t round_boxes(const tree_frame<2>&, const box_block<2>&,
                                                     std::size_t, std::uint32_t, split_record*,
                                                     half_extents*);
extern template TREEFORM_API std::size_t round_boxes(const tree_frame<3>&, const box_block<3>&,
                                                     std::size_t, std::uint32_t, split_record*,
                                                     half_extents*);

}  // namespace treeform::detail
