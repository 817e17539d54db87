#include <libmesh/place/align_starts.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace treeform::detail::place {
namespace {

constexpr unsigned steps_of_try = 15;
constexpr double most_of_robust = 0.6;  ///< share that has a partner, where weights find it out

/// `count` turns, spread evenly over all of them.
std::vector<Matrix3d> spread_turns(std::size_t count) {
    constexpr double phi = std::numbers::sqrt2, psi = 1.533751168755204288118041;
    std::vector<Matrix3d> turns;
    for (std::size_t i = 0; i < count; ++i) {
        const double s = static_cast<double>(i) + 0.5, t = s / static_cast<double>(count);
        const double r = std::sqrt(t), q = std::sqrt(1.0 - t);
        const double a = 2.0 * std::numbers::pi * s / phi, b = 2.0 * std::numbers::pi * s / psi;
        turns.push_back(
            rotation_of(q * std::cos(b), r * std::sin(a), r * std::cos(a), q * std::sin(b)));
    }
    std::stable_sort(turns.begin(), turns.end(),
                     [](const Matrix3d& x, const Matrix3d& y) { return x.trace() > y.trace(); });
    return turns;
}

/// The place where `center` goes to `to`, turned by `turn`.
similarity placed_turned(const Matrix3d& turn, double scale, const Vector3d& center,
                         const Vector3d& to) {
    return {scale, turn, to - scale * (turn * center)};
}

similarity about_center(const Vector3d& center, const Matrix3d& turn) {
    return {1.0, turn, center - turn * center};
}

template <class At, class Weight>
inertia inertia_by(std::size_t count, const At& at, const Weight& weight) {
    inertia of;
    double weights = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        of.center += weight(i) * at(i);
        weights += weight(i);
    }
    if (weights > 0.0) of.center /= weights;
    Matrix3d sums = Matrix3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3d arm = at(i) - of.center;
        sums += weight(i) * arm * arm.transpose();
    }
    of.axes = eigen_of(sums).vectors;
    if (weights > 0.0) of.radius = std::sqrt(sums.trace() / weights);
    if (is_mirrored(of.axes)) of.axes.col(0) *= -1.0;
    return of;
}

}  // namespace

inertia inertia_of(std::span<const Vector3d> points) {
    return inertia_by(
        points.size(), [&](std::size_t i) { return points[i]; }, [](std::size_t) { return 1.0; });
}

inertia inertia_of(std::span<const Vector3d> points, std::span<const face> faces) {
    const auto corner = [&](std::size_t f, std::size_t k) { return points[faces[f][k]]; };
    return inertia_by(
        faces.size(),
        [&](std::size_t f) { return Vector3d((corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3.0); },
        [&](std::size_t f) {
            return cross_product(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)).norm();
        });
}

std::vector<similarity> starts_of(const inertia& moving, const inertia& fixed,
                                  const similarity& present, std::size_t count) {
    std::vector<similarity> starts{present};
    const Vector3d flips[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (const Vector3d& flip : flips)
        starts.push_back(placed_turned(fixed.axes * flip.asDiagonal() * moving.axes.transpose(),
                                       present.scale, moving.center, fixed.center));
    const std::size_t more = count > starts.size() ? count - starts.size() : 0;
    for (const Matrix3d& turn : spread_turns(more))
        starts.push_back(
            placed_turned(turn * present.rotation, present.scale, moving.center, fixed.center));
    starts.resize(std::max<std::size_t>(std::min(count, starts.size()), 1));
    return starts;
}

std::vector<similarity> starts_near(const Vector3d& center, const similarity& present,
                                    double diagonal) {
    constexpr double angle = 0.25, way = 0.08;
    std::vector<similarity> starts{present};
    const auto add = [&](const Vector3d& turn, const Vector3d& shift) {
        similarity start = after(about_center(center, rotation_by(angle * turn)), present);
        start.shift += way * diagonal * shift;
        starts.push_back(start);
    };
    const Vector3d none = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        for (const double sign : {1.0, -1.0}) {
            const Vector3d along = sign * Vector3d::Unit(k);
            add(none, along);
            add(along, none);
            for (const double other : {1.0, -1.0}) {
                add(along, other * Vector3d::Unit((k + 1) % 3));
                add(along, other * Vector3d::Unit((k + 2) % 3));
            }
        }
    return starts;
}

std::vector<similarity> starts_along(std::span<const freedom> motions, double most,
                                     const similarity& at, double diagonal) {
    std::vector<similarity> starts{at};
    for (const freedom& one : motions) {
        if (one.stiffness >= most) continue;
        for (double by = 0.001; by < 0.1; by *= 2.0)
            for (const double way : {by * diagonal, -by * diagonal}) {
                similarity start = at;
                start.rotation = rotation_by(way * one.turn) * at.rotation;
                start.shift += way * one.shift;
                starts.push_back(start);
            }
    }
    return starts;
}

std::vector<tried_start> try_starts(const search_task& task, const moving_points& few,
                                    std::span<const similarity> starts,
                                    function_ref<bool(std::size_t)> go_on) {
    search_task quick = task;
    quick.max_iterations = std::min(task.max_iterations, steps_of_try);
    quick.tolerance = std::max(task.tolerance, 1e-3);
    quick.welsch = false;
    quick.scale = false;
    if (task.welsch) quick.overlap = std::min(task.overlap, most_of_robust);
    std::vector<tried_start> tried;
    for (std::size_t i = 1; i < starts.size() && go_on(i); ++i) {
        matching last;
        tried.push_back({i, search(quick, few, starts[i], last, [](unsigned) { return true; })});
        search_result& end = tried.back().end;
        end.at = quality_at(quick, few, end.map, endless, last);
    }
    std::stable_sort(tried.begin(), tried.end(), [](const tried_start& a, const tried_start& b) {
        return a.end.at.cost < b.end.at.cost;
    });
    return tried;
}

}  // namespace treeform::detail::place
