#pragma once
/// \file
/// The floating-point filter of pairs of faces, several pairs at once.
///
/// Every decision is based on the sign of the polynomial of `orient3d` (libmesh/exact), computed in
/// the same order of operations and compared with its error bound; if that does not decide, the
/// pair stays undecided.

#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/answers.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::intersect {

/// The three corners of a face, and its number.
using numbered_face = std::array<std::uint32_t, 4>;

/// A candidate of a block: its number there, and the relevant corner of each face; see
/// `candidate_classes`. Packed into one word, since storing four fields costs more than all other
/// work.
class candidate {
  public:
    candidate() = default;
    constexpr candidate(std::uint32_t index, std::uint32_t corners) : bits_(index | corners) {}
    /// The second argument of the constructor.
    static constexpr std::uint32_t corners(std::uint32_t of_a, std::uint32_t of_b) {
        return turns_from(of_a) << 16 | turns_from(of_b) << 24;
    }
    [[nodiscard]] std::uint32_t index() const { return bits_ & 0xFFFFU; }
    /// The relevant corner, or the first or second one after it.
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

/// The candidates of a block, by the corners that they share by number.
struct candidate_classes {
    enum name : std::size_t {
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

/// The corners of up to 64 pairs of one class, as a structure of arrays, so that the filter reads a
/// vector of pairs at once. Rows are padded to whole vectors.
struct pair_batch {
    static constexpr std::size_t capacity = 64;
    alignas(64) double at[6][3][capacity];

    /// The triangle of pair i with corners `first_corner` and the two after it.
    [[nodiscard]] triangle3 triangle(std::size_t first_corner, std::size_t i) const {
        triangle3 t;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis) t[k][axis] = at[first_corner + k][axis][i];
        return t;
    }
};

/// Number of corners that the filter reads for a class. For faces that share an edge u v: u, v and
/// the opposite corners of a and b; for a shared corner p: p, the other two of a, the other two of
/// b; else the three of a and the three of b.
template <candidate_classes::name Class>
inline constexpr std::size_t filtered_corners = 6 - Class;
static_assert(filtered_corners<candidate_classes::edge> == 4);

/// The certain decisions of the filter, as a bit for each pair of a batch; all other pairs are
/// undecided.
struct batch_verdict {
    std::uint64_t apart = 0;  ///< no common point beyond the shared corners
    /// they pass through each other, from the shared corner if there is one
    std::uint64_t pierce = 0;
};

/// \pre the batch has the corners of `count` pairs, padded to a multiple of 8
template <candidate_classes::name Class>
[[nodiscard]] batch_verdict filter_pairs(const pair_batch& batch, std::size_t count);
template <>
batch_verdict filter_pairs<candidate_classes::edge>(const pair_batch&, std::size_t);
template <>
batch_verdict filter_pairs<candidate_classes::corner>(const pair_batch&, std::size_t);
template <>
batch_verdict filter_pairs<candidate_classes::separate>(const pair_batch&, std::size_t);

/// The filters hold for coordinates up to this magnitude: no product of three differences then
/// exceeds what filter.hpp of libmesh/exact allows.
inline constexpr double largest_filtered_coordinate = 0x1p199;

}  // namespace treeform::detail::intersect
