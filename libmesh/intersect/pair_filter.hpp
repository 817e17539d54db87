#pragma once
/// \file
/// The floating-point filter of pairs of faces, several pairs at once.
///
/// Every decision rests on the sign of the polynomial of `orient3d` (libmesh/exact), computed in
/// its order of operations and held against its bound; what that bound leaves open stays open.

#include <treeform/tree/search_self.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::intersect {

/// The corners of a face, and its number.
using numbered_face = std::array<std::uint32_t, 4>;

/// A candidate of a block: its number there, and for each face the corner that matters; see
/// `candidate_classes`. One word, since a store of four fields together costs more than the rest.
class candidate {
  public:
    candidate() = default;
    constexpr candidate(std::uint32_t index, std::uint32_t corners) : bits_(index | corners) {}
    /// The second argument of the constructor.
    static constexpr std::uint32_t corners(std::uint32_t of_a, std::uint32_t of_b) {
        return turns_from(of_a) << 16 | turns_from(of_b) << 24;
    }
    [[nodiscard]] std::uint32_t index() const { return bits_ & 0xFFFFU; }
    /// The corner that matters, or the first or second one after it.
    template <unsigned Steps>
    [[nodiscard]] std::uint32_t corner_a() const {
        return bits_ >> (16 + 2 * Steps) & 3U;
    }
    template <unsigned Steps>
    [[nodiscard]] std::uint32_t corner_b() const {
        return bits_ >> (24 + 2 * Steps) & 3U;
    }

  private:
    static constexpr std::uint32_t turns_from(std::uint32_t corner) {
        return corner | (corner + 1) % 3 << 2 | (corner + 2) % 3 << 4;
    }

    std::uint32_t bits_;
};
static_assert(max_candidates <= 0x10000);

/// The candidates of a block by the corners they share by number.
struct candidate_classes {
    enum : std::size_t {
        separate,  ///< none
        corner,    ///< one: corner_a of a is corner_b of b
        edge,      ///< two, an edge of both: corner_a of a and corner_b of b are off it
        other      ///< three, or a face repeats a corner
    };
    std::array<std::size_t, 4> count;
    std::array<std::array<candidate, max_candidates>, 4> list;
};

/// Sorts a block by class; the order within a class is that of the block.
void sort_by_class(const candidate_block& block, const numbered_face* faces,
                   candidate_classes& classes);

/// The corners of up to 64 pairs of one class, a row of numbers for each coordinate of each
/// corner, so that the filter reads a vector of pairs at once. Rows are filled to whole vectors.
template <std::size_t Corners>
struct pair_batch {
    static constexpr std::size_t capacity = 64;
    alignas(64) double at[Corners][3][capacity];
};

/// What the filter is certain of, a bit for each pair of a batch; the rest is open.
struct batch_verdict {
    std::uint64_t apart = 0;   ///< no common point beyond the shared corners
    std::uint64_t pierce = 0;  ///< they pass through each other, from the corner they share if any
};

/// Corners u, v, a, b: faces u v a and u v b.
[[nodiscard]] batch_verdict filter_edge_pairs(const pair_batch<4>& batch, std::size_t count);

/// Corners p, a1, a2, b1, b2: faces p a1 a2 and p b1 b2.
[[nodiscard]] batch_verdict filter_corner_pairs(const pair_batch<5>& batch, std::size_t count);

/// Corners a0, a1, a2, b0, b1, b2: faces that share nothing.
[[nodiscard]] batch_verdict filter_separate_pairs(const pair_batch<6>& batch, std::size_t count);

/// The filters hold for coordinates up to this magnitude: no product of three differences then
/// exceeds what filter.hpp of libmesh/exact allows.
inline constexpr double largest_filtered_coordinate = 0x1p199;

}  // namespace treeform::detail::intersect
