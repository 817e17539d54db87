#pragma once
/// \file
/// The compiled half of the build: from records and boxes to ids and nodes.

#include <libtree/detail/buffer.hpp>
#include <libtree/detail/function_ref.hpp>
#include <libtree/detail/split.hpp>
#include <libtree/export.hpp>
#include <libtree/tree.hpp>

#include <cstddef>

namespace tf::detail {

/// A primitive's box in the frame of the tree, rounded outward.
template <std::size_t D>
struct float_box {
    float min[D];
    float max[D];
};

/// What a build needs beside the tree itself; kept by `builder`, a rebuild allocates nothing.
template <std::size_t D>
struct build_memory {
    buffer<split_record> records;
    buffer<float_box<D>> boxes;
};

/// Selection in place: no record of [first, nth) behind one of [nth, last) along `axis`.
using select_records =
    function_ref<void(split_record* first, split_record* nth, split_record* last, int axis)>;

/// Where the records [N] belong before `build_from_records`; the shape of `tree` is set.
template <std::size_t D>
[[nodiscard]] TREEFORM_API split_record* records_of(tree<D>& tree, build_memory<D>& memory,
                                                    const select_records* select);

/// Fills `tree`, whose shape and frame are set, from the records at `records_of` and
/// `memory.boxes` [N]. `select` replaces the default selection where it is not null.
/// \same on any number of threads
template <std::size_t D>
TREEFORM_API void build_from_records(tree<D>& tree, build_memory<D>& memory,
                                     const select_records* select);

extern template TREEFORM_API split_record* records_of(tree<2>&, build_memory<2>&,
                                                      const select_records*);
extern template TREEFORM_API split_record* records_of(tree<3>&, build_memory<3>&,
                                                      const select_records*);
extern template TREEFORM_API void build_from_records(tree<2>&, build_memory<2>&,
                                                     const select_records*);
extern template TREEFORM_API void build_from_records(tree<3>&, build_memory<3>&,
                                                     const select_records*);

}  // namespace tf::detail
