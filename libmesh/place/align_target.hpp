#pragma once
/// \file
/// The fixed side of an alignment, which finds the partners of points that move a little each time.

#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/align_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// Points to align, in an order of space, and the planes there if those count, too.
struct moving_points {
    std::vector<Vector3d> points;
    std::vector<surfel> surfels;  ///< [P], or none
    [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The partners of points at one place, and what of them helps to find those at the next.
struct matching {
    std::vector<partner> partners;        ///< [P]; their weights are not set
    std::vector<point3> moved;            ///< [P]
    std::vector<double> radii;            ///< [P] of a mesh: the last partner is no further
    std::vector<std::uint32_t> searched;  ///< of a cloud, those looked for anew
    /// Of a cloud, where each point was when it was looked for last, what was nearest to it then,
    /// and how far away all others were, at least.
    struct last_search {
        Vector3d at;
        std::array<std::uint32_t, 8> near;
        std::uint32_t count = 0;  ///< of `near`; 0: never looked for, or there was nothing
        double others = 0.0;
    };
    std::vector<last_search> last;
    std::vector<near_point> near;  ///< [P] likewise, what is nearest
};

/// A mesh, or a cloud, in the frame of the alignment.
class align_target {
  public:
    /// A cloud if it has no faces.
    align_target(std::vector<point3> points, std::vector<face> faces);

    [[nodiscard]] bool is_cloud() const { return faces_.empty(); }
    /// Fits planes to the points of a cloud. There are none before.
    void find_planes();

    /// The partners of `points`, in an order of space and at `map`, those that have one within
    /// `radius`. What `last` holds is of the same points, or nothing.
    /// \throws std::overflow_error when a point is not finite there
    void match(const moving_points& points, const similarity& map, double radius,
               matching& last) const;

  private:
    void match_mesh(double radius, matching& last) const;
    void match_cloud(const moving_points& points, const similarity& map, double radius,
                     matching& last) const;
    /// Makes the fixed point the partner of moving point i.
    void meet(const moving_points& points, const similarity& map, std::size_t i,
              const near_point& nearest, partner& p) const;
    [[nodiscard]] Vector3d normal_of_face(std::uint32_t f) const;

    std::vector<point3> points_;
    std::vector<face> faces_;
    nearness::closest_point_query on_faces_;
    searched_cloud cloud_;
    std::vector<surfel> surfels_;  ///< [V] of a cloud, once there are planes
};

}  // namespace treeform::detail::place
