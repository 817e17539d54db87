#pragma once
/// \file
/// The fixed side of an alignment, which finds the partners of points that move a little each time.

#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/align_steps.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/point_search.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

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
};

/// A mesh, or a cloud, in the frame of the alignment.
class align_target {
  public:
    /// A cloud if it has no faces.
    align_target(std::vector<point3> points, std::vector<face> faces);

    [[nodiscard]] bool is_cloud() const { return faces_.empty(); }
    /// Distance from which two points of a cloud are neighbors: the root mean square of those to
    /// the nearest other point, known once there are normals. 0 of a mesh.
    [[nodiscard]] double spacing() const { return spacing_; }
    /// Fits planes to the points of a cloud. Normals are zero before, and where there is no plane.
    void find_normals();

    /// The partners of `points`, in an order of space and at `map`, those that have one within
    /// `radius`. What `last` holds is of the same points, or nothing.
    /// \throws std::overflow_error when a point is not finite there
    void match(std::span<const Vector3d> points, const similarity& map, double radius,
               matching& last) const;

  private:
    void match_mesh(double radius, matching& last) const;
    void match_cloud(double radius, matching& last) const;
    [[nodiscard]] bool is_still_near(const matching::last_search& before, partner& p) const;
    [[nodiscard]] Vector3d normal_of_face(std::uint32_t f) const;

    std::vector<point3> points_;
    std::vector<face> faces_;
    std::vector<Vector3d> normals_;  ///< [V] of a cloud
    double spacing_ = 0.0;
    nearness::closest_point_query on_faces_;
    point_search<3> among_points_;
};

}  // namespace treeform::detail::place
