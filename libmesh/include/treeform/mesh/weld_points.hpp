#pragma once
/// \file
/// Points within a distance of each other become one point, by a rule that says which.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/points.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace treeform {

enum class weld_rule : std::uint8_t {
    /// In their order, a point is dropped when an earlier kept one lies within the tolerance of it;
    /// it then belongs to the nearest of these, the earliest among equally near ones. No two kept
    /// points are within the tolerance, no point is further than that from the one it belongs to,
    /// and welding what was kept again changes nothing.
    first,
    /// Everything linked by steps of at most the tolerance is one group; its earliest point is
    /// kept. A point may be many tolerances away from it.
    chain
};

/// How neighbours are found; the groups are the same with each. Where points have many within the
/// tolerance none of these is followed to its end: kept points are looked up by cube, and chains
/// join whole cubes.
enum class neighbor_search : std::uint8_t {
    automatic,  ///< by what a look at the points says of their number within the tolerance
    window,     ///< points sorted along a line in general position, and a window sliding over them
    cells,      ///< points sorted by cubes as wide as the tolerance
    tree        ///< self-search of a `treeform::tree`
};

struct weld_options {
    double tolerance = 0.0;  ///< Euclidean, inclusive; 0: equal coordinates (-0 equals +0)
    weld_rule rule = weld_rule::first;
    neighbor_search search = neighbor_search::automatic;
    /// [V] or empty: points with different numbers are never put together.
    std::span<const std::uint32_t> kind{};
    /// Asked for pairs within the tolerance and of one kind, whether they may be put together; may
    /// be empty. Symmetric, and called from several threads at once.
    std::function<bool(std::uint32_t, std::uint32_t)> agree{};
    progress_callback progress{};
};

struct point_groups {
    std::vector<std::uint32_t> group_of_point;  ///< [V] groups are numbered by their first points
    std::vector<std::uint32_t>
        first_of_group;    ///< [G] the lowest-numbered point of each, ascending
    bool stopped = false;  ///< `progress` asked for it; the rest is empty
};

/// Groups points by the rule. Whether two points are within the tolerance is decided exactly on the
/// coordinates as given, and so is which of two is nearer. Points with a NaN or infinite coordinate
/// stay alone, also from their like.
///
/// \throws std::invalid_argument for a tolerance that is negative or not finite, a `kind` of
/// another
///         length than `points`, or more than 2^32 - 2 points
/// \cost   O(V log V) for any tolerance and any number of equal points, as long as `agree` is empty
///         or nearly always true; parallel, but for rule `first` where most points have several
///         others within the tolerance. Working memory and result are within 36 bytes a point;
///         50 for chains in dense places, 110 by `tree`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API point_groups weld_points(points_view points,
                                                    const weld_options& options);

/// `mesh` with the points of each group joined: the groups' first points in order and unmoved,
/// faces in order, also those that now repeat a corner. Nothing else is dropped.
///
/// \throws std::invalid_argument for groups of another number of points, or naming the lowest face
///         with a corner that is no point
/// \cost   O(V + F)
[[nodiscard]] TREEFORM_API mesh join_groups(mesh_view mesh, const point_groups& groups);

}  // namespace treeform
