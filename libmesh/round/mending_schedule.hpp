#pragma once
/// \file
/// What is tried, in which order and for how long, where rounding has broken a surface.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::round {

/// What mending has come to so far.
struct mending_state {
    int steps = 0;                     ///< taken
    std::uint64_t meeting = 0;         ///< faces that meet now
    std::uint64_t meeting_before = 0;  ///< before the last step
    std::uint64_t meeting_at_first = 0;
    std::size_t faces = 0;
    std::size_t faces_given = 0;
    bool only_cut = false;  ///< nothing is joined any more
};

/// The schedule of mending. First come steps of the surface: what is next to faces that meet is
/// joined to them, and the surface is cut along itself. Where that is not enough, and the surface
/// was made of operands, steps of these follow: their faces next to all places that were broken in
/// any step are joined, and the surface is made once more, with steps of its own as before.
///
/// Next to each other is what is nearer than 2^-48 of the largest coordinate in the first step of
/// each kind, 2^-22 for float32: four times as far in each further step of the surface, sixteen
/// times in each of the operands.
///
/// The numbers of one precision get denser toward the origin, so that rounding makes smaller and
/// smaller features there, and joining them ends nowhere. So, for float32 from the start unless few
/// faces meet, and else where the steps above have failed, mending is on uniform grids: what is next to broken
/// places is put on one, of operands and of the surface, and cut again, in rounds. The first grids
/// are those of 2^-22 of the largest coordinate for operands, 2^-48 for float64; the following ones
/// are sixteen times as wide. For the surface of each there are three, 2^-17, 2^-15 and 2^-13, or
/// 2^-43, 2^-41 and 2^-39 at first, of which each begins from the surface as it was first rounded,
/// so that neither moves nor pieces add up. They follow on joining, too. Operands as they are have
/// a surface on a grid of 2^-21, and at last on those three. All are wider than the precision, to
/// which cuts are rounded: on a grid of just the precision, cuts move as far as features are wide,
/// and each round breaks more than it mends. For the same reason each try starts from the operands,
/// not from what the one before has cut to pieces.
struct mending_schedule {
    treeform::precision precision = treeform::precision::float64;
    int surface_steps = 0;  ///< that are taken whether they help or not; none at all for 0
    int operand_steps = 0;

    /// `steps` in all: up to two of the surface, then those of operands.
    [[nodiscard]] static mending_schedule of_operands(int steps, treeform::precision precision);

    /// Whether a broken surface gets one more step: one of `surface_steps`, or one that follows,
    /// to 4, or 12 where nothing is joined, on one that left fewer faces that meet. None where the
    /// surface only grows by it.
    [[nodiscard]] bool mends_surface(const mending_state& state) const;
    /// How many pairs of faces may meet at first, of operands that are joined, if that many did
    /// before: more are not worth mending.
    [[nodiscard]] static std::uint64_t most_meeting(std::uint64_t meeting);

    /// What counts as next to each other in step 1, 2, ...
    /// \pre coordinates are finite \cost O(V)
    [[nodiscard]] double reach_of_surface(points_view points, int step) const;
    [[nodiscard]] double reach_of_operands(points_view points, int step) const;
    /// The grids in step 1, 2, ... of operands; of the surface also in step 0, for the operands as
    /// they are.
    /// \pre coordinates are finite \cost O(V)
    [[nodiscard]] double grid_of_surface(points_view points, int step) const;
    [[nodiscard]] double grid_of_operands(points_view points, int step) const;
    /// These and the next ones, four times as wide each, of which half a step is within the limit.
    [[nodiscard]] std::vector<double> grids_of_surface(points_view points, int step,
                                                       double limit) const;
    /// Whether only few faces meet, so that one more step costs little.
    [[nodiscard]] static bool are_few(const mending_state& state);
    /// Whether a broken surface gets one more round on its grid, as all do that have left fewer
    /// faces that meet, only few in the first round, or next to none of those at first, to 6, and
    /// 15 for all tries of a result together. More rounds where that is not so break more than they mend.
    [[nodiscard]] static bool mends_on_grid(const mending_state& state);
    /// Whether so many pairs of faces are too many to be cut, of a surface that had so many faces.
    [[nodiscard]] static bool is_too_much(std::uint64_t pairs, std::size_t faces_given);
    /// How many pairs of faces may meet of operands on a grid, or in float32, if that many did
    /// before: where more do, they are not worth cutting.
    [[nodiscard]] static std::uint64_t most_pairs(std::uint64_t pairs_given);
    /// The same of operands that are joined, in float64.
    [[nodiscard]] static std::uint64_t most_pairs_joined(std::uint64_t pairs_given);
    static constexpr int most_rounds = 15;  ///< of mending, of all tries of a result
    /// Of those that are left, how many the next try may take: half of them, so that a wider one
    /// may follow.
    [[nodiscard]] static int rounds_of_try(int left);
    static constexpr int most_rounds_of_grid = 6;  ///< on one grid
    static constexpr int most_grids = 3;           ///< of one try
};

}  // namespace treeform::detail::round
