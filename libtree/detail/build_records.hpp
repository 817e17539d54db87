#pragma once
/// \file
/// The compiled half of the build: from records to ids and nodes.

#include <libtree/detail/buffer.hpp>
#include <libtree/detail/function_ref.hpp>
#include <libtree/detail/split.hpp>
#include <libtree/export.hpp>
#include <libtree/tree.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

namespace tf::detail {

/// How far a primitive's box reaches from the centre in its record: three floats of 21 bits each
/// (sign-free, rounded up), in eight bytes, since gathering them by primitive is a random access.
class half_extents {
  public:
    half_extents() = default;
    /// \pre every h[k] >= 0 or infinite
    template <std::size_t D>
    explicit half_extents(const float (&h)[D]) {
        bits_ = 0;
        for (std::size_t k = 0; k < D; ++k) {
            // Adding to the bits of a float goes to the next larger one, from the greatest to
            // infinity.
            const std::uint32_t up = std::bit_cast<std::uint32_t>(h[k]) + ((1U << dropped) - 1);
            bits_ |= std::uint64_t{up >> dropped} << (kept * k);
        }
    }
    /// At least h[k], and at most 2^-13 of it more.
    [[nodiscard]] float operator[](std::size_t k) const {
        const auto up = static_cast<std::uint32_t>(bits_ >> (kept * k)) & ((1U << kept) - 1);
        return std::bit_cast<float>(up << dropped);
    }

  private:
    static constexpr unsigned kept = 21;  // 8 of exponent, 13 of mantissa
    static constexpr unsigned dropped = 10;
    std::uint64_t bits_;
};

/// What a build needs beside the tree itself; kept by `builder`, a rebuild allocates nothing.
struct build_memory {
    buffer<split_record> records;
    buffer<half_extents> extents;
};

/// Selection in place: no record of [first, nth) behind one of [nth, last) along `axis`.
using select_records =
    function_ref<void(split_record* first, split_record* nth, split_record* last, int axis)>;

/// Where the records [N] belong before `build_from_records`; the shape of `tree` is set.
template <std::size_t D>
[[nodiscard]] TREEFORM_API split_record* records_of(tree<D>& tree, build_memory& memory,
                                                    const select_records* select);

/// Fills `tree`, whose shape and frame are set, from the records at `records_of` and
/// `memory.extents` [N]. `select` replaces the default selection where it is not null.
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

}  // namespace tf::detail
