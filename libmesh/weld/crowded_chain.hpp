#pragma once
/// \file
/// Welds one tile by the rule `chain`, in memory proportional to the occupied space, not to the
/// number of points.

#include <libmesh/weld/tile_weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <memory>
#include <span>

namespace treeform::detail::weld {

/// Produces the results of `tile_weld` with the rule `chain` for tiles with too many points for
/// memory. Needs three passes, `find_cubes`, `link_cubes` and `append_result`, each over the same
/// points in the same order, in pieces of any size.
///
/// All points in a cube whose diagonal is the tolerance are linked. `find_cubes` finds the cubes
/// and joins those whose first points are within the tolerance. Other cubes may be joined by their
/// other points: `link_cubes` keeps the points, without duplicates, that are within the tolerance
/// of the bounding box of the points of a cube that is not joined yet. In dense regions these are
/// few, since most cubes there are already joined.
class TREEFORM_API crowded_chain {
  public:
    /// \throws std::invalid_argument for a tolerance that is negative or not finite
    explicit crowded_chain(double tolerance);
    ~crowded_chain();
    crowded_chain(crowded_chain&&) noexcept;
    crowded_chain& operator=(crowded_chain&&) noexcept;

    /// First pass. \pre all coordinates are finite; point numbers ascend over all calls
    /// \throws std::invalid_argument for more than 2^32 - 2 cubes
    /// \cost O(1) a point; about 130 bytes a cube
    void find_cubes(std::span<const tile_point> points);
    /// Second pass, after the last `find_cubes`.
    /// \cost O(1) a point where cubes are dense; about 60 bytes for each point kept
    void link_cubes(std::span<const tile_point> points);
    /// Third pass, after the last `link_cubes`: appends to `out` what a `tile_weld` would.
    void append_result(std::span<const tile_point> points, tile_result& out);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::detail::weld
