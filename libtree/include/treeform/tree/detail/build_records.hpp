#pragma once
/// \file
/// The compiled half of the build: from records to ids and nodes.

#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>
#include <treeform/tree/detail/split.hpp>
#include <treeform/tree/tree.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail {

/// Names the built-in selection of `build` (libtree/build/split.cpp). It works on packed records
/// with a scratch array, so it has no `partition` over arbitrary iterators.
struct bracketed_select {};

/// The half extents of a primitive's box about the center in its record. Packed into eight bytes,
/// since they are gathered by random access: D floats of 21 bits each, without a sign, rounded up,
/// the last axis in the lowest bits.
class half_extents {
  public:
    static constexpr unsigned kept = 21;  ///< 8 of exponent, 13 of mantissa
    static constexpr unsigned dropped = 10;

    /// The half extent on axis `k` of D, rounded up by at most 2^-13 of it.
    template <std::size_t D>
    [[nodiscard]] float on_axis(std::size_t k) const {
        const std::uint64_t bits = bits_ >> (kept * (D - 1 - k)) & ((1U << kept) - 1);
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << dropped);
    }

  private:
    std::uint64_t bits_;
};

/// The memory of a build besides the tree. `builder` keeps it, so that a rebuild allocates nothing.
struct build_memory {
    buffer<split_record> records;
    buffer<half_extents> extents;
};

/// Selection in place: reorders so that no record of [first, nth) is beyond one of [nth, last)
/// along `axis`.
using select_records =
    function_ref<void(split_record* first, split_record* nth, split_record* last, int axis)>;

/// The array [N] to fill with records before `build_from_records`. The shape of `tree` must be set.
template <std::size_t D>
[[nodiscard]] TREEFORM_API split_record* records_of(tree<D>& tree, build_memory& memory,
                                                    const select_records* select);

/// Fills `tree`, whose shape and frame are set, from the records at `records_of` and
/// `memory.extents` [N]. `select` replaces the default selection unless it is null.
/// \same on any number of threads
template <std::size_t D>
TREEFORM_API void build_from_records(tree<D>& tree, build_memory& memory,
                                     const select_records* select);

extern template TREEFORM_API split_record* records_of(tree<2>&, build_memory&,
                                                      const select_records*);
extern template TREEFORM_API split_record* records_of(tree<3>&, build_memory&,
                                                      const select_records*);
extern template TREEFORM_API void build_from_records(tree<2>&, build_memory&,
                                                     const select_records*);
extern template TREEFORM_API void build_from_records(tree<3>&, build_memory&,
                                                     const select_records*);

}  // namespace treeform::detail
