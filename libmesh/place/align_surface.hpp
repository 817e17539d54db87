#pragma once
/// \file
/// How the surface that a cloud was taken from lies at its points.

#include <libmesh/place/solvers.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/point_search.hpp>

#include <array>
#include <span>
#include <vector>

namespace treeform::detail::place {

inline Vector3d vector_of(const point3& p) { return {p.x, p.y, p.z}; }
inline std::array<double, 3> array_of(const point3& p) { return {p.x, p.y, p.z}; }

/// The plane fitted to the neighbors of a point.
struct surfel {
    Vector3d normal = Vector3d::Zero();  ///< zero where there is none
    double reach = 0.0;                  ///< how far the neighbors are
    double thickness = 0.0;              ///< how far they are from it: root mean square
};

/// A cloud without equal points, which finds what is near. Scanners put what they do not see at the
/// origin, thousands of times: a search would look at all of them, since all are as near.
class searched_cloud {
  public:
    searched_cloud() = default;
    explicit searched_cloud(std::vector<point3> points);

    [[nodiscard]] const std::vector<point3>& points() const { return points_; }
    [[nodiscard]] const point_search<3>& search() const { return search_; }

    /// At each of the places, by the 12 points nearest to it. Where these are on a line, as on the
    /// rings that a turning scanner leaves, by 4 or 16 times as many.
    [[nodiscard]] std::vector<surfel> surfels_at(std::span<const point3> places) const;

  private:
    std::vector<point3> points_;
    point_search<3> search_;
};

}  // namespace treeform::detail::place
