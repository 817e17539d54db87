#include <libmesh/base/point_math.hpp>
#include <libmesh/place/align_target.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace treeform::detail::place {
namespace {

/// Points that a plane of a cloud is fitted to.
constexpr std::size_t points_of_plane = 12;

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

/// Scanners put what they do not see at the origin, thousands of times: a search would look at all
/// of them, since all are as near.
void leave_out_equal(std::vector<point3>& points) {
    const auto key = [](const point3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(),
              [&](const point3& a, const point3& b) { return key(a) < key(b); });
    const auto equal = [&](const point3& a, const point3& b) { return key(a) == key(b); };
    points.erase(std::unique(points.begin(), points.end(), equal), points.end());
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
    return least_direction(sums);
}

}  // namespace

align_target::align_target(std::vector<point3> points, std::vector<face> faces)
    : points_(std::move(points)), faces_(std::move(faces)) {
    if (!is_cloud()) {
        on_faces_ = nearness::closest_point_query({points_, faces_});
        return;
    }
    leave_out_equal(points_);
    among_points_ = point_search<3>(points_, array_of);
    normals_.assign(points_.size(), Vector3d::Zero());
}

void align_target::find_normals() {
    if (!is_cloud() || spacing_ > 0.0) return;
    std::vector<std::array<double, 3>> places;
    for (const point3& p : points_) places.push_back(array_of(p));
    const auto near = among_points_.k_nearest(places, points_of_plane);
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
        cross_product(vector_of(points_[faces_[f][1]]) - a, vector_of(points_[faces_[f][2]]) - a);
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

/// Finds the partner among what was near when the point was looked for last; false where it may be
/// another one, since the point has moved too far from there.
bool align_target::is_still_near(const matching::last_search& before, partner& p) const {
    std::uint32_t nearest = 0;
    double least = endless;
    for (std::uint32_t k = 0; k < before.count; ++k) {
        const std::uint32_t id = before.near[k];
        const double squared = (p.from - vector_of(points_[id])).squaredNorm();
        if (squared < least || (squared == least && id < nearest)) {
            least = squared;
            nearest = id;
        }
    }
    const double distance = std::sqrt(least);
    if (!(distance < (before.others - (p.from - before.at).norm()) * (1.0 - 1e-12) - 1e-14))
        return false;
    p.to = vector_of(points_[nearest]);
    p.distance = distance;
    p.normal = normals_[nearest];
    return true;
}

void align_target::match_cloud(double radius, matching& last) const {
    const std::size_t count = last.moved.size();
    last.last.resize(count);
    for_chunks(count, block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            partner& p = last.partners[i];
            p = {};
            p.from = vector_of(last.moved[i]);
            static_cast<void>(is_still_near(last.last[i], p));
        }
    });
    last.searched.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (!(last.partners[i].distance < endless))
            last.searched.push_back(static_cast<std::uint32_t>(i));
    std::vector<std::array<double, 3>> queries;
    queries.reserve(last.searched.size());
    for (const std::uint32_t i : last.searched) queries.push_back(array_of(last.moved[i]));
    constexpr std::size_t wanted = std::tuple_size_v<decltype(matching::last_search::near)>;
    const auto found = among_points_.k_nearest(queries, wanted, radius);
    for_chunks(queries.size(), block, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t q = begin; q < end; ++q) {
            const auto near = found[q];
            partner& p = last.partners[last.searched[q]];
            auto& entry = last.last[last.searched[q]];
            entry.at = p.from;
            entry.count = static_cast<std::uint32_t>(near.size());
            for (std::size_t k = 0; k < near.size(); ++k) entry.near[k] = near[k].id;
            entry.others = near.size() == wanted ? near.back().distance : radius;
            if (near.empty()) continue;
            p.to = vector_of(points_[near[0].id]);
            p.distance = near[0].distance;
            p.normal = normals_[near[0].id];
        }
    });
    for (partner& p : last.partners)
        if (p.distance > radius) p.distance = endless;
}

}  // namespace treeform::detail::place
