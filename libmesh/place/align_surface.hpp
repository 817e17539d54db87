#pragma once
/// \file
/// Local planes of the surface that a point cloud samples.

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
    Vector3d normal = Vector3d::Zero();  ///< zero: no plane
    double reach = 0.0;                  ///< distance to the farthest neighbor
    double thickness = 0.0;  ///< root mean square distance of the neighbors to the plane
};

/// A point cloud without duplicates, with a search for nearest points. Scanners put thousands of
/// rays without a return at the origin; a search would visit all of these, since they are equally
/// near.
class searched_cloud {
  public:
    searched_cloud() = default;
    explicit searched_cloud(std::vector<point3> points);

    [[nodiscard]] const std::vector<point3>& points() const { return points_; }
    [[nodiscard]] const point_search<3>& search() const { return search_; }

    /// Fits a plane at each of `places` to the 12 nearest points. If these are on a line, as on the
    /// rings of a rotating scanner, to 4 or 16 times as many.
    [[nodiscard]] std::vector<surfel> surfels_at(std::span<const point3> places) const;

  private:
    std::vector<point3> points_;
    point_search<3> search_;
};

}  // namespace treeform::detail::place
