#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/place/align_target.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace treeform::detail::place {
namespace {

constexpr std::size_t points_of_plane = 12;
constexpr std::size_t most_of_plane = 16 * points_of_plane;
constexpr double like_line = 0.05;  ///< of the squares across, to those along

void leave_out_equal(std::vector<point3>& points) {
    const auto key = [](const point3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(),
              [&](const point3& a, const point3& b) { return key(a) < key(b); });
    const auto equal = [&](const point3& a, const point3& b) { return key(a) == key(b); };
    points.erase(std::unique(points.begin(), points.end(), equal), points.end());
}

/// False where the points are on a line.
bool fit_plane(const std::vector<point3>& points, std::span<const near_point> of, surfel& to) {
    to.reach = of.empty() ? 0.0 : of.back().distance;
    if (of.size() < 3) return false;
    Vector3d center = Vector3d::Zero();
    for (const near_point& n : of) center += vector_of(points[n.id]);
    center /= static_cast<double>(of.size());
    Matrix3d sums = Matrix3d::Zero();
    for (const near_point& n : of) {
        const Vector3d arm = vector_of(points[n.id]) - center;
        sums += arm * arm.transpose();
    }
    const eigen_system<3> system = eigen_in_closed_form(sums);
    if (!(system.values(1) > like_line * system.values(2))) return false;
    to.normal = system.vectors.col(0);
    // three points are in the plane whatever it is
    const double free = std::max(static_cast<double>(of.size()) - 3.0, 1.0);
    to.thickness = std::sqrt(std::max(system.values(0), 0.0) / free);
    return true;
}

/// What distances across the normals count for, on planes: enough where nothing else holds points,
/// as of a flat cloud on itself, and too little to hold points on the rings of a scanner.
constexpr double slack_on_planes = 1e-3;

/// In the plane of a face but beside it, a point would be left there by the normal of the face.
/// On the surface, except for rounding, directions say nothing.
Vector3d normal_between(const Vector3d& from, const Vector3d& to, double distance,
                        const Vector3d& of_face) {
    const Vector3d off = from - to;
    const double above = off.dot(of_face);
    if (distance <= 1e-9 || std::abs(above) >= 0.999 * distance) return of_face;
    return off / (above < 0.0 ? -distance : distance);
}

/// On the plane between those of both sides. The less these agree, the more only the distance
/// counts; so does what is beyond the neighbors of the fixed point.
void meet_on_planes(const surfel& there, const Vector3d& normal, double thickness, partner& p) {
    const Vector3d off = p.from - p.to;
    const double cosine = there.normal.dot(normal);
    const Vector3d both = there.normal + (cosine < 0.0 ? -1.0 : 1.0) * normal;
    const double length = both.norm();
    p.normal = length > 0.0 ? Vector3d(both / length) : both;
    p.hold = std::max(2.0 * cosine * cosine - 1.0, 0.0);
    p.slack = slack_on_planes;
    p.noise = std::hypot(there.thickness, thickness);
    const double along = off.dot(p.normal), whole = off.squaredNorm();
    const double across = std::max(whole - along * along, 0.0);
    const double beyond = std::max(std::sqrt(across) - there.reach, 0.0);
    p.distance = std::sqrt((1.0 - p.hold) * whole +
                           p.hold * (along * along + beyond * beyond + slack_on_planes * across));
}

}  // namespace

searched_cloud::searched_cloud(std::vector<point3> points) : points_(std::move(points)) {
    leave_out_equal(points_);
    search_ = point_search<3>(points_, array_of);
}

std::vector<surfel> searched_cloud::surfels_at(std::span<const point3> places) const {
    std::vector<surfel> found(places.size());
    std::vector<std::uint32_t> open(places.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<std::uint32_t>(i);
    std::vector<std::uint8_t> fits(places.size());
    for (std::size_t k = points_of_plane; k <= most_of_plane && !open.empty(); k *= 4) {
        std::vector<std::array<double, 3>> queries;
        queries.reserve(open.size());
        for (const std::uint32_t i : open) queries.push_back(array_of(places[i]));
        const auto near = search_.k_nearest(queries, k);
        base::for_numbers(open.size(), 256, [&](std::size_t i) {
            fits[open[i]] = fit_plane(points_, near[i], found[open[i]]) ? 1 : 0;
        });
        std::erase_if(open, [&](std::uint32_t i) { return fits[i] != 0; });
    }
    return found;
}

align_target::align_target(std::vector<point3> points, std::vector<face> faces)
    : points_(std::move(points)), faces_(std::move(faces)) {
    if (is_cloud())
        cloud_ = searched_cloud(std::move(points_));
    else
        on_faces_ = nearness::closest_point_query({points_, faces_});
}

void align_target::find_planes() {
    if (is_cloud() && surfels_.empty()) surfels_ = cloud_.surfels_at(cloud_.points());
}

Vector3d align_target::normal_of_face(std::uint32_t f) const {
    const Vector3d a = vector_of(points_[faces_[f][0]]);
    const Vector3d n =
        cross_product(vector_of(points_[faces_[f][1]]) - a, vector_of(points_[faces_[f][2]]) - a);
    const double length = n.norm();
    return length > 0.0 ? Vector3d(n / length) : Vector3d(Vector3d::Zero());
}

void align_target::match(const moving_points& points, const similarity& map, double radius,
                         matching& last) const {
    const std::size_t count = points.size();
    last.moved.resize(count);
    base::for_numbers(count, block, [&](std::size_t i) {
        const Vector3d p = map(points.points[i]);
        last.moved[i] = {p.x(), p.y(), p.z()};
    });
    if (!base::all_finite(last.moved))
        throw std::overflow_error("treeform::align: the moving points are too far away");
    last.partners.resize(count);
    if (is_cloud())
        match_cloud(points, map, radius, last);
    else
        match_mesh(radius, last);
}

void align_target::match_mesh(double radius, matching& last) const {
    const std::size_t count = last.moved.size();
    last.radii.resize(count);
    base::for_numbers(count, block, [&](std::size_t i) {
        const partner& before = last.partners[i];
        last.radii[i] = radius;
        if (before.distance < endless)
            last.radii[i] = std::min(
                radius, (vector_of(last.moved[i]) - before.to).norm() * (1 + 1e-12) + 1e-12);
    });
    const auto found = on_faces_.nearest_in_order(last.moved, last.radii);
    base::for_numbers(count, block, [&](std::size_t i) {
        partner& p = last.partners[i];
        p = {};
        p.from = vector_of(last.moved[i]);
        if (!found[i]) return;
        p.to = vector_of(found[i]->point);
        p.distance = found[i]->distance;
        p.normal = normal_between(p.from, p.to, p.distance, normal_of_face(found[i]->face));
    });
}

namespace {

/// The nearest of what was near when the point was looked for last; none where it may be another
/// one, since the point has moved too far from there.
std::optional<near_point> still_nearest(const std::vector<point3>& points,
                                        const matching::last_search& before, const Vector3d& from) {
    near_point nearest{0, endless};
    for (std::uint32_t k = 0; k < before.count; ++k) {
        const std::uint32_t id = before.near[k];
        const double squared = (from - vector_of(points[id])).squaredNorm();
        if (squared < nearest.distance || (squared == nearest.distance && id < nearest.id))
            nearest = {id, squared};
    }
    nearest.distance = std::sqrt(nearest.distance);
    const double reach = (before.others - (from - before.at).norm()) * (1.0 - 1e-12) - 1e-14;
    return nearest.distance < reach ? std::optional(nearest) : std::nullopt;
}

}  // namespace

void align_target::meet(const moving_points& points, const similarity& map, std::size_t i,
                        const near_point& nearest, partner& p) const {
    p.to = vector_of(cloud_.points()[nearest.id]);
    p.distance = nearest.distance;
    if (surfels_.empty()) return;
    const surfel& there = surfels_[nearest.id];
    p.normal = there.normal;
    p.noise = there.thickness;
    if (points.surfels.empty()) return;
    const surfel& here = points.surfels[i];
    meet_on_planes(there, map.rotation * here.normal, map.scale * here.thickness, p);
}

void align_target::match_cloud(const moving_points& points, const similarity& map, double radius,
                               matching& last) const {
    const std::size_t count = last.moved.size();
    last.last.resize(count);
    last.near.resize(count);
    base::for_numbers(count, block, [&](std::size_t i) {
        partner& p = last.partners[i];
        p = {};
        p.from = vector_of(last.moved[i]);
        const auto nearest = still_nearest(cloud_.points(), last.last[i], p.from);
        last.near[i] = nearest.value_or(near_point{0, endless});
    });
    last.searched.clear();
    for (std::size_t i = 0; i < count; ++i)
        if (!(last.near[i].distance < endless))
            last.searched.push_back(static_cast<std::uint32_t>(i));
    std::vector<std::array<double, 3>> queries;
    queries.reserve(last.searched.size());
    for (const std::uint32_t i : last.searched) queries.push_back(array_of(last.moved[i]));
    constexpr std::size_t wanted = std::tuple_size_v<decltype(matching::last_search::near)>;
    const auto found = cloud_.search().k_nearest(queries, wanted, radius);
    base::for_numbers(queries.size(), block, [&](std::size_t q) {
        const auto near = found[q];
        auto& entry = last.last[last.searched[q]];
        entry.at = last.partners[last.searched[q]].from;
        entry.count = static_cast<std::uint32_t>(near.size());
        for (std::size_t k = 0; k < near.size(); ++k) entry.near[k] = near[k].id;
        entry.others = near.size() == wanted ? near.back().distance : radius;
        if (!near.empty()) last.near[last.searched[q]] = near[0];
    });
    base::for_numbers(count, block, [&](std::size_t i) {
        if (last.near[i].distance <= radius && last.near[i].distance < endless)
            meet(points, map, i, last.near[i], last.partners[i]);
    });
}

}  // namespace treeform::detail::place
