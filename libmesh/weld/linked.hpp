#pragma once
/// \file
/// Whether two sets of points have points within the tolerance of each other.

#include <libmesh/weld/reach.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::weld {

/// Predicate: whether two points have the same label, are within the tolerance and may be merged.
class matcher {
  public:
    /// \pre both arguments outlive the object
    matcher(points_view points, const weld_options& options)
        : points_(points), options_(&options), within_(options.tolerance) {}

    /// \pre both points are finite
    [[nodiscard]] bool operator()(std::uint32_t i, std::uint32_t j) const {
        return (options_->label.empty() || options_->label[i] == options_->label[j]) &&
               within_.holds(points_[i], points_[j]) &&
               (!options_->may_merge || options_->may_merge(i, j));
    }
    [[nodiscard]] bool near(const point3& a, const point3& b) const { return within_.holds(a, b); }
    [[nodiscard]] const point3& point(std::uint32_t i) const { return points_[i]; }
    /// Whether all points with the same label within the tolerance match.
    [[nodiscard]] bool by_distance() const { return !options_->may_merge; }

  private:
    points_view points_;
    const weld_options* options_;
    reach within_;
};

/// Whether some point of `a` matches one of `b`. Both have the same label, and both are reordered.
///
/// \cost O(|a| + |b|) if their boxes or a few near points decide; recursive bisection if two
///       surfaces run along each other at a distance of about the tolerance
[[nodiscard]] bool any_match(const matcher& match, std::span<std::uint32_t> a,
                             std::span<std::uint32_t> b);

}  // namespace treeform::detail::weld
