#pragma once
/// \file
/// One tile with the rule chain in memory that depends on the space it fills, not on its points.

#include <libmesh/weld/tile_weld.hpp>
#include <treeform/tree/detail/export.hpp>

#include <memory>
#include <span>

namespace treeform::detail::weld {

/// What `tile_weld` says of a tile with the rule chain, for tiles whose points are too many to be
/// held. It goes over them three times: `look`, `link`, `settle`, each with the same points in the
/// same order, in pieces of any size.
///
/// Points of a cube whose diagonal is the tolerance are one. `look` finds the cubes and joins those
/// whose first points are within the tolerance. Whether others are is up to their points, of which
/// `link` keeps those that are as near as the tolerance to the box around the points of a cube that
/// is not joined yet; equal ones once. Where points are crowded these are few, as the cubes of a
/// crowd are soon one.
class TREEFORM_API crowded_chain {
  public:
    /// \throws std::invalid_argument for a tolerance that is negative or not finite
    explicit crowded_chain(double tolerance);
    ~crowded_chain();
    crowded_chain(crowded_chain&&) noexcept;
    crowded_chain& operator=(crowded_chain&&) noexcept;

    /// First. \pre all coordinates are finite, and numbers ascend over all calls
    /// \throws std::invalid_argument for more than 2^32 - 2 cubes
    /// \cost O(1) a point; some 130 bytes a cube
    void look(std::span<const tile_point> points);
    /// Second, after the last `look`.
    /// \cost O(1) a point where cubes are crowded; some 60 bytes for each that is kept
    void link(std::span<const tile_point> points);
    /// Third, after the last `link`: appends what a `tile_weld` does.
    void settle(std::span<const tile_point> points, tile_result& out);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform::detail::weld
