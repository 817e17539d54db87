#pragma once
/// \file
/// The lengths that an alignment computes in, and both of its sides in them; how well these agree
/// whatever their scale.

#include <libmesh/place/align_search.hpp>
#include <libmesh/place/align_target.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::place {

inline point3 to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Centers both sides and scales them by a power of two, to a fixed diagonal near 1, so that
/// results depend neither on the unit nor on the distance to the origin. The linear part of the
/// initial transform is applied to the moving points; `offset` is the rest of it.
struct align_frame {
    double by = 1.0;
    double diagonal = 0.0;  ///< diagonal of the fixed box, scaled
    point3 center{};        ///< center of the fixed box
    point3 pivot{};         ///< center of the moving box
    Matrix3d linear = Matrix3d::Identity();
    Vector3d offset = Vector3d::Zero();

    align_frame(points_view moving, points_view fixed, const transform<3>& start);

    [[nodiscard]] point3 fixed(const point3& p) const {
        return {(p.x - center.x) * by, (p.y - center.y) * by, (p.z - center.z) * by};
    }
    [[nodiscard]] Vector3d moving(const point3& p) const {
        return by * (linear * (vector_of(p) - vector_of(pivot)));
    }
};

[[nodiscard]] transform<3> matrix_of(const align_frame& f, const similarity& map,
                                     const point3& pivot_moved);

/// All moving points in Morton order. With `once`, only the first of consecutive equal points is
/// kept: scanners put rays without a return at the origin.
[[nodiscard]] moving_points in_order(const align_frame& f, points_view moving, bool once);

/// Fits planes to all of the points.
void find_planes(moving_points& moving);

/// At most `most` points, evenly spaced in the order of `all`; with 0, all points.
[[nodiscard]] moving_points some_of(const moving_points& all, std::size_t most);

/// All points except the judges (`is_judge`). If there are few points, all are fitted, including
/// the judges.
[[nodiscard]] moving_points fitted_of(const moving_points& all);

[[nodiscard]] align_target target_in(const align_frame& f, mesh_view fixed);

/// The center and principal axes of the fixed side: of a mesh weighted by area, of a cloud by
/// points.
[[nodiscard]] inertia inertia_in(const align_frame& f, mesh_view fixed);

/// Compares alignments of different scales. A one-sided cost is least if the moving points collapse
/// to one point, or if they are far larger than the fixed side. This cost is a product: the median
/// distance from the moving to the fixed points, in lengths of the moving side, times the median
/// distance from the fixed to the moving points, in lengths of the fixed side. It is the same if
/// the sides are exchanged.
class both_ways {
  public:
    both_ways(const moving_points& few, const align_frame& frame, mesh_view fixed);

    [[nodiscard]] double cost_at(const search_task& task, const similarity& map) const;

  private:
    const moving_points& few_;
    searched_cloud moving_;
    std::vector<Vector3d> fixed_;
};

}  // namespace treeform::detail::place
