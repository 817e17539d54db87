#include <libmesh/base/point_math.hpp>
#include <libmesh/place/align_target.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform::detail::place {
namespace {

/// Points that a plane of a cloud is fitted to.
constexpr std::size_t around = 12;

Vector3d vector_of(const point3& p) { return {p.x, p.y, p.z}; }
std::array<double, 3> array_of(const point3& p) { return {p.x, p.y, p.z}; }

/// In the plane of a face but beside it, a point would be left there by the normal of the face.
/// On the surface, except for rounding, directions say nothing.
Vector3d normal_between(const Vector3d& from, const Vector3d& to, double distance,
                        const Vector3d& of_face) {
    const Vector3d off = from - to;
    const double above = off.dot(of_face);
    if (distance <= 1e-9 || std::abs(above) >= 0.999 * distance) return of_face;
    return off / (above < 0.0 ? -distance : distance);
}

Vector3d plane_normal(const std::vector<point3>& points, std::span<const near_point> of) {
    if (of.size() < 3) return Vector3d::Zero();
    Vector3d center = Vector3d::Zero();
    for (const near_point& n : of) center += vector_of(points[n.id]);
    center /= static_cast<double>(of.size());
    Matrix3d sums = Matrix3d::Zero();
    for (const near_point& n : of) {
        const Vector3d arm = vector_of(points[n.id]) - center;
        sums += arm * arm.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    solver.computeDirect(sums);
    return solver.eigenvectors().col(0);
}

}  // namespace

align_target::align_target(std::vector<point3> points, std::vector<face> faces)
    : points_(std::move(points)), faces_(std::move(faces)) {
    if (!is_cloud()) {
        on_faces_ = nearness::closest_point_query({points_, faces_});
        return;
    }
    among_points_ = point_search<3>(points_, array_of);
    normals_.assign(points_.size(), Vector3d::Zero());
}

void align_target::find_normals() {
    if (!is_cloud() || spacing_ > 0.0) return;
    std::vector<std::array<double, 3>> places;
    for (const point3& p : points_) places.push_back(array_of(p));
    const auto near = among_points_.k_nearest(places, around);
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (near[i].size() > 1) sum += near[i][1].distance * near[i][1].distance;
    spacing_ = std::max(std::sqrt(sum / static_cast<double>(places.size())), 1e-300);
    for_chunks(places.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) normals_[i] = plane_normal(points_, near[i]);
    });
}

Vector3d align_target::normal_of_face(std::uint32_t f) const {
    const Vector3d a = vector_of(points_[faces_[f][0]]);
    const Vector3d n =
        (vector_of(points_[faces_[f][1]]) - a).cross(vector_of(points_[faces_[f][2]]) - a);
    const double length = n.norm();
    return length > 0.0 ? Vector3d(n / length) : Vector3d(Vector3d::Zero());
}

void align_target::match(std::span<const Vector3d> points, const similarity& map, double radius,
                         matching& last) const {
    const std::size_t count = points.size();
    last.moved.resize(count);
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vector3d p = map(points[i]);
            last.moved[i] = {p.x(), p.y(), p.z()};
        }
    });
    if (!base::all_finite(last.moved))
        throw std::overflow_error("treeform::align: the moving points are too far away");
    last.partners.resize(count);
    if (is_cloud())
        match_cloud(radius, last);
    else
        match_mesh(radius, last);
}

void align_target::match_mesh(double radius, matching& last) const {
    const std::size_t count = last.moved.size();
    last.radii.resize(count);
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const partner& before = last.partners[i];
            last.radii[i] = radius;
            if (before.distance < endless)
                last.radii[i] = std::min(
                    radius, (vector_of(last.moved[i]) - before.to).norm() * (1 + 1e-12) + 1e-12);
        }
    });
    const auto found = on_faces_.nearest_in_order(last.moved, last.radii);
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            partner& p = last.partners[i];
            p = {};
            p.from = vector_of(last.moved[i]);
            if (!found[i]) continue;
            p.to = vector_of(found[i]->point);
            p.distance = found[i]->distance;
            p.normal = normal_between(p.from, p.to, p.distance, normal_of_face(found[i]->face));
        }
    });
}

void align_target::match_cloud(double radius, matching& last) const {
    const std::size_t count = last.moved.size();
    last.last.resize(count);
    // What was nearest by far when a point was looked for still is when it has moved less than that.
    const auto still_nearest = [&](std::size_t i) {
        const auto& before = last.last[i];
        if (before.others < 0.0) return false;
        const Vector3d at = vector_of(last.moved[i]);
        const double now = (at - vector_of(points_[before.nearest])).norm();
        return now < (before.others - (at - before.at).norm()) * (1.0 - 1e-12) - 1e-14;
    };
    last.searched.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (!still_nearest(i)) last.searched.push_back(static_cast<std::uint32_t>(i));
    std::vector<std::array<double, 3>> queries;
    for (const std::uint32_t i : last.searched) queries.push_back(array_of(last.moved[i]));
    const auto found = among_points_.k_nearest(queries, 2, radius);
    for_chunks(queries.size(), block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t q = begin; q < end; ++q) {
            auto& entry = last.last[last.searched[q]];
            const auto near = found[q];
            entry.others = -1.0;
            if (near.empty()) continue;
            entry = {vector_of(last.moved[last.searched[q]]), near[0].id,
                     near.size() > 1 ? near[1].distance : radius};
        }
    });
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            partner& p = last.partners[i];
            p = {};
            p.from = vector_of(last.moved[i]);
            const auto& entry = last.last[i];
            if (entry.others < 0.0) continue;
            p.to = vector_of(points_[entry.nearest]);
            const double distance = (p.from - p.to).norm();
            if (distance > radius) continue;
            p.distance = distance;
            p.normal = normals_[entry.nearest];
        }
    });
}

}  // namespace treeform::detail::place
