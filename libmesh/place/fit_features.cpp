#include <libmesh/base/point_math.hpp>
#include <libmesh/place/fit_features.hpp>
#include <libmesh/place/solvers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace treeform::detail::place {
namespace {

using vector3 = vector<3>;
using square3 = square<3>;

vector3 eigen(const point3& p) { return {p.x, p.y, p.z}; }
point3 point(const vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Faces as numbers near 1, whatever their size and place.
struct local_faces {
    struct one {
        std::array<vector3, 3> corner;
        vector3 normal;  ///< of length 1
        double area;
    };
    std::vector<one> faces;
    vector3 origin = vector3::Zero();
    double unit = 1.0;
    double area = 0.0;  ///< of all, in the unit

    local_faces(mesh_view mesh, std::span<const std::uint32_t> ids) {
        vector3 low = vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const std::uint32_t f : ids)
            for (const std::uint32_t i : mesh.faces[f]) {
                low = low.cwiseMin(eigen(mesh.points[i]));
                high = high.cwiseMax(eigen(mesh.points[i]));
            }
        if (ids.empty()) return;
        origin = 0.5 * low + 0.5 * high;
        unit = std::max((0.5 * high - 0.5 * low).maxCoeff(), 1e-300);
        for (const std::uint32_t f : ids) {
            one face;
            for (std::size_t k = 0; k < 3; ++k)
                face.corner[k] = (eigen(mesh.points[mesh.faces[f][k]]) - origin) / unit;
            const vector3 normal =
                cross_product(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
            face.area = 0.5 * normal.norm();
            if (!(face.area > 0.0)) continue;
            face.normal = normal / (2.0 * face.area);
            area += face.area;
            faces.push_back(face);
        }
    }

    [[nodiscard]] vector3 center() const {
        vector3 sum = vector3::Zero();
        for (const one& f : faces) sum += f.area / 3.0 * (f.corner[0] + f.corner[1] + f.corner[2]);
        return sum / area;
    }
    /// Of the area about its center.
    [[nodiscard]] square3 covariance(const vector3& about) const {
        square3 sum = square3::Zero();
        for (const one& f : faces) {
            const vector3 a = f.corner[0] - about, b = f.corner[1] - about, c = f.corner[2] - about;
            const vector3 all = a + b + c;
            sum +=
                f.area / 12.0 *
                (a * a.transpose() + b * b.transpose() + c * c.transpose() + all * all.transpose());
        }
        return sum;
    }
};

mesh_feature begin_feature(feature_kind kind, const local_faces& local,
                           std::span<const std::uint32_t> ids) {
    mesh_feature feature{.kind = kind, .area = local.area * local.unit * local.unit};
    feature.faces.assign(ids.begin(), ids.end());
    std::sort(feature.faces.begin(), feature.faces.end());
    return feature;
}

void find_deviation(mesh_view mesh, mesh_feature& feature) {
    for (const std::uint32_t f : feature.faces)
        for (const std::uint32_t i : mesh.faces[f])
            feature.deviation =
                std::max(feature.deviation, std::abs(distance_from(feature, mesh.points[i])));
}

/// A cylinder of local faces.
struct cylinder {
    vector3 origin, direction;
    double radius = 0.0;

    [[nodiscard]] vector3 across(const vector3& p) const {
        const vector3 from = p - origin;
        return from - direction * from.dot(direction);
    }
};

/// The axis square to the normals; its place by the circle through the corners (Kasa's fit, which
/// is linear).
std::optional<cylinder> first_guess(const local_faces& local) {
    square3 normals = square3::Zero();
    for (const auto& f : local.faces) normals += f.area * (f.normal * f.normal.transpose());
    const auto [values, vectors] = eigen_of(normals);
    if (!(values[1] > 1e-12 * values[2])) return std::nullopt;
    cylinder c{vector3::Zero(), vectors.col(0), 0.0};
    const vector3 e1 = vectors.col(1), e2 = vectors.col(2);
    square3 left = square3::Zero();
    vector3 right = vector3::Zero();
    for (const auto& f : local.faces)
        for (const vector3& p : f.corner) {
            const vector3 row{p.dot(e1), p.dot(e2), 1.0};
            const double square = row[0] * row[0] + row[1] * row[1];
            left += f.area * (row * row.transpose());
            right += f.area * square * row;
        }
    const vector3 x = solve(left, right);
    if (!x.allFinite()) return std::nullopt;
    c.origin = 0.5 * x[0] * e1 + 0.5 * x[1] * e2;
    c.radius = std::sqrt(std::max(0.0, x[2] + 0.25 * (x[0] * x[0] + x[1] * x[1])));
    return c;
}

/// Gauss-Newton steps on the distances of the corners from the cylinder, each weighted by its area.
void refine(const local_faces& local, cylinder& c) {
    using row5 = vector<5>;
    for (int step = 0; step < 30; ++step) {
        const vector3 e1 = any_orthogonal(c.direction), e2 = cross_product(c.direction, e1);
        square<5> left = square<5>::Zero();
        row5 right = row5::Zero();
        for (const auto& f : local.faces)
            for (const vector3& p : f.corner) {
                const vector3 from = c.across(p);
                const double distance = from.norm();
                if (!(distance > 0.0)) continue;
                const vector3 out = from / distance;
                const double along = (p - c.origin).dot(c.direction);
                row5 row;
                row << -out.dot(e1), -out.dot(e2), -along * out.dot(e1), -along * out.dot(e2), -1.0;
                left += f.area * (row * row.transpose());
                right -= f.area * (distance - c.radius) * row;
            }
        const row5 change = solve(left, right);
        if (!change.allFinite()) return;
        c.origin += change[0] * e1 + change[1] * e2;
        c.direction = (c.direction + change[2] * e1 + change[3] * e2).normalized();
        c.radius += change[4];
        if (change.norm() < 1e-15) return;
    }
}

}  // namespace

point3 double_area(mesh_view mesh, std::uint32_t face) {
    const auto t = base::triangle_of(mesh, face);
    return base::cross(base::minus(t[1], t[0]), base::minus(t[2], t[0]));
}

double distance_from(const mesh_feature& feature, const point3& p) {
    const point3 from = base::minus(p, feature.origin);
    const double along = base::dot(from, feature.direction);
    if (feature.kind == feature_kind::plane) return along;
    const point3 across = base::minus(from, base::scaled(feature.direction, along));
    return std::sqrt(base::dot(across, across)) - feature.radius;
}

circle_arc arc_of(mesh_view mesh, const mesh_feature& axis) {
    const vector3 d = eigen(axis.direction), e1 = any_orthogonal(d), e2 = cross_product(d, e1);
    std::vector<double> angles;
    for (const std::uint32_t f : axis.faces)
        for (const std::uint32_t i : mesh.faces[f]) {
            const vector3 from = eigen(base::minus(mesh.points[i], axis.origin));
            angles.push_back(std::atan2(from.dot(e2), from.dot(e1)) * 180.0 / std::numbers::pi);
        }
    if (angles.empty()) return {};
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 360.0 - angles.back();
    std::size_t lines = widest > 0.1 ? 1 : 0;
    for (std::size_t i = 1; i < angles.size(); ++i) {
        const double gap = angles[i] - angles[i - 1];
        widest = std::max(widest, gap);
        lines += gap > 0.1 ? 1 : 0;
    }
    return {360.0 - widest, lines};
}

std::optional<mesh_feature> fit_plane(mesh_view mesh, std::span<const std::uint32_t> ids) {
    const local_faces local(mesh, ids);
    if (!(local.area > 0.0)) return std::nullopt;
    const vector3 center = local.center();
    vector3 normal = eigen_of(local.covariance(center)).vectors.col(0), sum = vector3::Zero();
    bool all_alike = true;  // then their own normal is exact, which moments are not
    for (const auto& f : local.faces) {
        sum += f.area * f.normal;
        all_alike = all_alike && f.normal == local.faces[0].normal;
    }
    if (all_alike) normal = local.faces[0].normal;
    if (normal.dot(sum) < 0.0) normal = -normal;
    mesh_feature feature = begin_feature(feature_kind::plane, local, ids);
    feature.origin = point(local.origin + local.unit * center);
    feature.direction = point(normal);
    find_deviation(mesh, feature);
    return feature;
}

std::optional<mesh_feature> fit_axis(mesh_view mesh, std::span<const std::uint32_t> ids,
                                     const mesh_feature* start) {
    const local_faces local(mesh, ids);
    if (!(local.area > 0.0)) return std::nullopt;
    std::optional<cylinder> c;
    if (start != nullptr)
        c = cylinder{(eigen(start->origin) - local.origin) / local.unit, eigen(start->direction),
                     start->radius / local.unit};
    else
        c = first_guess(local);
    if (!c) return std::nullopt;
    refine(local, *c);
    if (!(c->radius > 0.0) || !std::isfinite(c->radius) || !c->direction.allFinite())
        return std::nullopt;
    double outward = 0.0;
    for (const auto& f : local.faces)
        outward +=
            f.area * f.normal.dot(c->across((f.corner[0] + f.corner[1] + f.corner[2]) / 3.0));
    // The center of the faces, on the axis; which way that looks by its first coordinate not small.
    const vector3 center = local.center();
    vector3 d = c->direction;
    for (int k = 2; k >= 0; --k)
        if (std::abs(d[k]) > 1e-6) {
            if (d[k] < 0.0) d = -d;
            break;
        }
    mesh_feature feature = begin_feature(feature_kind::axis, local, ids);
    const vector3 at = c->origin + d * (center - c->origin).dot(d);
    feature.origin = point(local.origin + local.unit * at);
    feature.direction = point(d);
    feature.radius = local.unit * c->radius;
    feature.hollow = outward < 0.0;
    find_deviation(mesh, feature);
    return feature;
}

}  // namespace treeform::detail::place
