#pragma once
/// \file
/// The fixed side of an alignment, which finds the partners of points that move a little each time,
/// and how the surface that a cloud was taken from lies at its points.

#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/solvers.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/point_search.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
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

/// Points to align, in a spatial order, and optionally the planes at them.
struct moving_points {
    std::vector<Vector3d> points;
    std::vector<surfel> surfels;  ///< [P]; empty: no planes
    [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The partners of the points at one transform, and cached data that speeds up the next search.
struct matching {
    std::vector<partner> partners;  ///< [P]; their weights are not set
    std::vector<point3> moved;      ///< [P]
    /// [P] for a mesh: upper bounds on the distances to the last partners
    std::vector<double> radii;
    std::vector<std::uint32_t> searched;  ///< for a cloud: the points searched anew
    /// For a cloud: the position of a point at its last search, its nearest fixed points then, and
    /// a lower bound on the distance of all other fixed points.
    struct last_search {
        Vector3d at;
        std::array<std::uint32_t, 8> near;
        std::uint32_t count = 0;  ///< used entries of `near`; 0: never searched, or nothing found
        double others = 0.0;
    };
    std::vector<last_search> last;
    std::vector<near_point> near;  ///< [P] for a cloud: the nearest points
};

/// The fixed mesh or cloud, in the frame of the alignment.
class align_target {
  public:
    /// Without faces, a cloud.
    align_target(std::vector<point3> points, std::vector<face> faces);

    [[nodiscard]] bool is_cloud() const { return faces_.empty(); }
    /// Fits planes to the points of a cloud. Until it is called, a cloud has no planes.
    void find_planes();

    /// Finds the partners within `radius` of `points`, moved by `map`. `points` are in a spatial
    /// order; `last` is empty or was filled for the same points.
    /// \throws std::overflow_error when a moved point is not finite
    void match(const moving_points& points, const similarity& map, double radius,
               matching& last) const;

  private:
    void match_mesh(double radius, matching& last) const;
    void match_cloud(const moving_points& points, const similarity& map, double radius,
                     matching& last) const;
    /// Sets `p`, the partner of moving point i, from its nearest fixed point.
    void meet(const moving_points& points, const similarity& map, std::size_t i,
              const near_point& nearest, partner& p) const;
    [[nodiscard]] Vector3d normal_of_face(std::uint32_t f) const;

    std::vector<point3> points_;
    std::vector<face> faces_;
    nearness::closest_point_query on_faces_;
    searched_cloud cloud_;
    std::vector<surfel> surfels_;  ///< [V] for a cloud, after `find_planes`
};

}  // namespace treeform::detail::place
