#pragma once
/// \file
/// The lengths that an alignment computes in, and both of its sides in them.

#include <libmesh/place/align_starts.hpp>
#include <libmesh/place/align_target.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>

namespace treeform::detail::place {

inline point3 to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Both sides about their centers, in lengths of a power of two near the fixed diagonal, so that
/// nothing depends on the unit or on how far the origin is. The linear part of the start is applied
/// to the moving points; what remains of the start is `offset`.
struct align_frame {
    double by = 1.0;
    double diagonal = 0.0;  ///< of the fixed box, in these lengths
    point3 center{};        ///< of the fixed box
    point3 pivot{};         ///< of the moving box
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

/// All moving points in an order of space; with `once`, of those that follow each other there and
/// are equal only the first: a scanner puts what it does not see at the origin.
[[nodiscard]] moving_points in_order(const align_frame& f, points_view moving, bool once);

/// Fits planes to all of the points.
void find_planes(moving_points& moving);

/// At most so many, spread evenly; 0 is all.
[[nodiscard]] moving_points some_of(const moving_points& all, std::size_t most);

/// All but the judges. Where there are few points all are fitted, and the judges are among them.
[[nodiscard]] moving_points fitted_of(const moving_points& all);

[[nodiscard]] align_target target_in(const align_frame& f, mesh_view fixed);

/// Where the fixed side is and how it lies: by area, of a cloud by points.
[[nodiscard]] inertia inertia_in(const align_frame& f, mesh_view fixed);

}  // namespace treeform::detail::place
