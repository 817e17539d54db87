#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/place/align_steps.hpp>
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using detail::place::block;
using detail::place::partner;
using detail::place::share_of;
using detail::place::similarity;
using detail::place::sum_over;
using detail::place::trim;
using Eigen::Matrix3d;
using Eigen::Vector3d;

void refuse(const std::string& what) { throw std::invalid_argument("treeform::align: " + what); }

void check(const char* of, points_view points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (!std::isfinite(points[i][k]))
                refuse(std::string(of) + " point " + std::to_string(i) + " is not finite");
}

void check(points_view moving, mesh_view fixed, const align_options& o) {
    check("moving", moving);
    check("fixed", fixed.points);
    detail::base::check_faces("align", fixed.points.size(), fixed.faces);
    if (!(o.overlap > 0.0 && o.overlap <= 1.0)) refuse("the overlap is not in (0, 1]");
    if (!(o.max_distance >= 0.0)) refuse("the largest distance is negative or NaN");
    if (!(o.tolerance >= 0.0)) refuse("the tolerance is negative or NaN");
    if (!o.start.finite()) refuse("an entry of the start is not finite");
}

Vector3d to_eigen(const point3& p) { return {p.x, p.y, p.z}; }
point3 to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Both sides about their centers, in lengths of a power of two near the fixed diagonal, so that
/// nothing depends on the unit or on how far the origin is. The linear part of the start is applied
/// to the moving points; what remains of the start is `offset`.
struct frame {
    double by = 1.0;
    point3 center{};  ///< of the fixed box
    point3 pivot{};   ///< of the moving box
    Matrix3d linear = Matrix3d::Identity();
    Vector3d offset = Vector3d::Zero();

    frame(points_view moving, points_view fixed, const transform<3>& start) {
        const auto middle = [](const box3& box) {
            return point3{0.5 * box.min.x + 0.5 * box.max.x, 0.5 * box.min.y + 0.5 * box.max.y,
                          0.5 * box.min.z + 0.5 * box.max.z};
        };
        const box3 box = *bounding_box(fixed);
        center = middle(box);
        pivot = middle(*bounding_box(moving));
        int exponent = 0;
        std::frexp(diagonal(box), &exponent);
        by = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                linear(r, c) = start.rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
        offset = by * (to_eigen(start(pivot)) - to_eigen(center));
    }

    [[nodiscard]] point3 fixed(const point3& p) const {
        return {(p.x - center.x) * by, (p.y - center.y) * by, (p.z - center.z) * by};
    }
    [[nodiscard]] Vector3d moving(const point3& p) const {
        return by * (linear * (to_eigen(p) - to_eigen(pivot)));
    }
};

/// The fixed side, scaled; points are faces of no area when there are no others.
class target {
  public:
    target(mesh_view fixed, const frame& f) : faces_(fixed.faces.begin(), fixed.faces.end()) {
        points_.reserve(fixed.points.size());
        for (const point3& p : fixed.points) points_.push_back(f.fixed(p));
        if (faces_.empty()) faces_ = detail::base::point_faces(points_.size());
        query_ = detail::nearness::closest_point_query({points_, faces_});
    }

    /// The partners of points, those that have one within `radius`.
    [[nodiscard]] std::vector<partner> partners(const std::vector<Vector3d>& points,
                                                const similarity& map, double radius) const {
        std::vector<point3> moved(points.size());
        for_chunks(points.size(), block, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) moved[i] = to_point(map(points[i]));
        });
        if (!detail::base::all_finite(moved))
            throw std::overflow_error("treeform::align: the moving points are too far away");
        const auto found = query_.nearest(moved, radius);
        std::vector<partner> result;
        result.reserve(found.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            if (found[i])
                result.push_back(with_plane({to_eigen(moved[i]), to_eigen(found[i]->point),
                                             normal(found[i]->face), found[i]->distance, i}));
        return result;
    }

  private:
    [[nodiscard]] Vector3d normal(std::uint32_t f) const {
        const Vector3d a = to_eigen(points_[faces_[f][0]]);
        const Vector3d n =
            (to_eigen(points_[faces_[f][1]]) - a).cross(to_eigen(points_[faces_[f][2]]) - a);
        const double length = n.norm();
        return length > 0.0 ? Vector3d(n / length) : Vector3d(Vector3d::Zero());
    }

    /// In the plane of a face but beside it, a point would be left there by the normal of the face.
    /// On the surface, except for rounding, directions say nothing.
    static partner with_plane(partner p) {
        const Vector3d off = p.from - p.to;
        if (p.distance > 1e-9 && std::abs(off.dot(p.normal)) < 0.999 * p.distance)
            p.normal = off / p.distance;
        return p;
    }

    std::vector<point3> points_;
    std::vector<face> faces_;
    detail::nearness::closest_point_query query_;
};

/// How good a place is: the mean of the squared distances that count, each no more than the
/// largest allowed, and what the result says of it.
struct quality {
    double cost = 0.0;
    double rms = 0.0;
    double overlap = 0.0;
};

quality quality_of(std::vector<partner> partners, std::size_t count, const align_options& o,
                   double radius) {
    quality q;
    q.overlap = static_cast<double>(partners.size()) / static_cast<double>(count);
    const std::size_t wanted = share_of(o.overlap, count);
    trim(partners, wanted);
    const double sum =
        sum_over(partners, 0.0, [](const partner& p) { return p.distance * p.distance; });
    if (!partners.empty()) q.rms = std::sqrt(sum / static_cast<double>(partners.size()));
    const auto missing = static_cast<double>(wanted - partners.size());
    q.cost =
        (sum + (missing > 0.0 ? missing * radius * radius : 0.0)) / static_cast<double>(wanted);
    return q;
}

/// How far a step moves the points of a ball of radius 1, at most.
double displacement(const similarity& step) {
    return (step.scale * step.rotation - Matrix3d::Identity()).norm() + step.shift.norm();
}

struct search_result {
    similarity map;
    bool converged = false;
    unsigned iterations = 0;
};

/// Steps from `map` on, and of the places on the way the best.
search_result search(const target& fixed, const std::vector<Vector3d>& samples,
                     const similarity& start, const align_options& o, double radius, bool planes,
                     detail::base::work_progress& work) {
    search_result best{start};
    similarity map = start;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned i = 0;; ++i) {
        std::vector<partner> partners = fixed.partners(samples, map, radius);
        const double cost = quality_of(partners, samples.size(), o, radius).cost;
        // Close to the end costs differ by their rounding alone, and the last place is the best.
        if (cost <= least * (1.0 + 1e-12) + 1e-28) {
            least = std::min(least, cost);
            best.map = map;
        }
        best.iterations = i;
        if (best.converged || i == o.max_iterations) return best;
        if (!work.step(0.2, 0.8, i, 10.0)) return best;
        trim(partners, share_of(o.overlap, samples.size()));
        if (partners.empty()) return best;
        const similarity step = planes ? detail::place::plane_step(partners, o.scale)
                                       : detail::place::point_step(partners, o.scale);
        if (!step.shift.allFinite() || !step.rotation.allFinite()) return best;
        map = detail::place::after(step, map);
        best.converged = displacement(step) <= o.tolerance;
    }
}

transform<3> matrix_of(const frame& f, const similarity& map, const point3& pivot_moved) {
    const Matrix3d linear = map.scale * map.rotation * f.linear;
    const Vector3d shift = to_eigen(pivot_moved) - linear * to_eigen(f.pivot);
    transform<3> m;
    for (int r = 0; r < 3; ++r)
        m.rows[static_cast<std::size_t>(r)] = {linear(r, 0), linear(r, 1), linear(r, 2), shift(r)};
    return m;
}

std::vector<Vector3d> some_of(const std::vector<Vector3d>& all, std::size_t most) {
    if (most == 0 || all.size() <= most) return all;
    std::vector<Vector3d> some;
    for (std::size_t i = 0; i < most; ++i)
        some.push_back(all[static_cast<std::size_t>(
            static_cast<double>(i) * static_cast<double>(all.size()) / static_cast<double>(most))]);
    return some;
}

align_result found_by_steps(points_view moving, mesh_view fixed, const align_options& options) {
    align_result result;
    result.matrix = options.start;
    if (moving.empty() || fixed.points.empty()) return result;

    const frame f(moving, fixed.points, options.start);
    const target scaled(fixed, f);
    std::vector<Vector3d> all;
    all.reserve(moving.size());
    for (const point3& p : moving) all.push_back(f.moving(p));
    similarity start;
    start.shift = f.offset;
    const double radius = options.max_distance * f.by;

    detail::base::work_progress work(options.progress);
    const auto judge = [&](const similarity& map) {
        return quality_of(scaled.partners(all, map, radius), all.size(), options, radius);
    };
    const bool planes = options.method == align_method::point_to_plane && !fixed.faces.empty();
    if (!work.reach(0.1)) return {.status = status::cancelled};
    const quality before = judge(start);
    if (!std::isfinite(before.cost))
        throw std::overflow_error("treeform::align: the distances are too large to be squared");
    if (!work.reach(0.2)) return {.status = status::cancelled};
    const search_result found =
        search(scaled, some_of(all, options.samples), start, options, radius, planes, work);
    if (work.cancelled()) return {.status = status::cancelled};
    const quality after_all = judge(found.map);
    if (!work.reach(1.0)) return {.status = status::cancelled};
    const bool better = after_all.cost < before.cost;
    const similarity& map = better ? found.map : start;
    const quality& end = better ? after_all : before;
    result.pivot = f.pivot;
    for (std::size_t k = 0; k < 3; ++k)
        result.pivot_moved[k] = f.center[k] + map.shift(static_cast<int>(k)) / f.by;
    if (better) result.matrix = matrix_of(f, map, result.pivot_moved);
    if (!result.matrix.finite())
        throw std::overflow_error("treeform::align: the coordinates are too large for a matrix");
    result.scale = map.scale;
    result.rms = end.rms / f.by;
    result.rms_at_start = before.rms / f.by;
    result.overlap = end.overlap;
    result.converged = found.converged && after_all.cost <= before.cost * (1.0 + 1e-12) + 1e-28;
    result.iterations = found.iterations;
    return result;
}

}  // namespace

align_result align(points_view moving, mesh_view fixed, const align_options& options) {
    check(moving, fixed, options);
    align_result result = found_by_steps(moving, fixed, options);
    if (result.status == status::cancelled) return result;
    result.points.reserve(moving.size());
    for (const point3& p : moving) {
        point3& q = result.points.emplace_back(result.matrix(p));
        for (std::size_t k = 0; k < 3 && options.precision == precision::float32; ++k)
            q[k] = detail::base::nearest_float(q[k]);
    }
    if (!detail::base::all_finite(result.points))
        throw std::overflow_error("treeform::align: the coordinates are too large to be written");
    return result;
}

align_result align(mesh_view moving, mesh_view fixed, const align_options& options) {
    return align(moving.points, fixed, options);
}

align_result align(const prepared_mesh& moving, const prepared_mesh& fixed,
                   const align_options& options) {
    mesh_view to = fixed.view();
    if (fixed.is_cloud()) to.faces = {};
    return align(moving.view().points, to, options);
}

}  // namespace treeform
