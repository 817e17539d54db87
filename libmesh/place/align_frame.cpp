#include <libmesh/place/align_frame.hpp>
#include <libmesh/place/align_steps.hpp>
#include <treeform/tree/detail/morton_order.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace treeform::detail::place {

align_frame::align_frame(points_view moving, points_view fixed, const transform<3>& start) {
    const auto middle = [](const box3& box) {
        return point3{0.5 * box.min.x + 0.5 * box.max.x, 0.5 * box.min.y + 0.5 * box.max.y,
                      0.5 * box.min.z + 0.5 * box.max.z};
    };
    const box3 box = *bounding_box(fixed);
    center = middle(box);
    pivot = middle(*bounding_box(moving));
    int exponent = 0;
    std::frexp(box.diagonal(), &exponent);
    by = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    diagonal = box.diagonal() * by;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            linear(r, c) = start.rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    offset = by * (vector_of(start(pivot)) - vector_of(center));
}

transform<3> matrix_of(const align_frame& f, const similarity& map, const point3& pivot_moved) {
    const Matrix3d linear = map.scale * map.rotation * f.linear;
    const Vector3d shift = vector_of(pivot_moved) - linear * vector_of(f.pivot);
    transform<3> m;
    for (int r = 0; r < 3; ++r)
        m.rows[static_cast<std::size_t>(r)] = {linear(r, 0), linear(r, 1), linear(r, 2), shift(r)};
    return m;
}

moving_points in_order(const align_frame& f, points_view moving, bool once) {
    std::vector<Vector3d> all(moving.size());
    const auto at = [&](std::size_t i) { return f.moving(moving[i]); };
    const auto order = treeform::detail::morton_order<3>(moving.size(), [&](std::size_t i) {
        const Vector3d p = at(i);
        return std::array<double, 3>{p.x(), p.y(), p.z()};
    });
    for (std::size_t i = 0; i < order.size(); ++i) all[i] = at(order[i]);
    if (once) all.erase(std::unique(all.begin(), all.end()), all.end());
    return {std::move(all), {}};
}

void find_planes(moving_points& moving) {
    std::vector<point3> points;
    points.reserve(moving.size());
    for (const Vector3d& p : moving.points) points.push_back(to_point(p));
    moving.surfels = searched_cloud(points).surfels_at(points);
}

moving_points some_of(const moving_points& all, std::size_t most) {
    if (most == 0 || all.size() <= most) return all;
    moving_points some;
    for (std::size_t i = 0; i < most; ++i) {
        const auto at = static_cast<std::size_t>(
            static_cast<double>(i) * static_cast<double>(all.size()) / static_cast<double>(most));
        some.points.push_back(all.points[at]);
        if (!all.surfels.empty()) some.surfels.push_back(all.surfels[at]);
    }
    return some;
}

moving_points fitted_of(const moving_points& all) {
    constexpr std::size_t many = 4000;
    if (all.size() < many) return all;
    moving_points fitted;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_judge(i)) continue;
        fitted.points.push_back(all.points[i]);
        if (!all.surfels.empty()) fitted.surfels.push_back(all.surfels[i]);
    }
    return fitted;
}

align_target target_in(const align_frame& f, mesh_view fixed) {
    std::vector<point3> points;
    points.reserve(fixed.points.size());
    for (const point3& p : fixed.points) points.push_back(f.fixed(p));
    return {std::move(points), {fixed.faces.begin(), fixed.faces.end()}};
}

inertia inertia_in(const align_frame& f, mesh_view fixed) {
    std::vector<Vector3d> points;
    for (const point3& p : fixed.points) points.push_back(vector_of(f.fixed(p)));
    return fixed.faces.empty() ? inertia_of(points) : inertia_of(points, fixed.faces);
}

both_ways::both_ways(const moving_points& few, const align_frame& frame, mesh_view fixed)
    : few_(few) {
    std::vector<point3> points;
    for (const Vector3d& p : few.points) points.push_back(to_point(p));
    moving_ = searched_cloud(std::move(points));
    constexpr std::size_t most_asked = 2000;  // of the fixed points
    const std::size_t step = fixed.points.size() / most_asked + 1;
    for (std::size_t i = 0; i < fixed.points.size(); i += step)
        fixed_.push_back(vector_of(frame.fixed(fixed.points[i])));
}

double both_ways::cost_at(const search_task& task, const similarity& map) const {
    matching last;
    task.fixed.match(few_, map, endless, last);
    std::vector<double> there, back;
    for (const partner& p : last.partners) there.push_back(p.distance / map.scale);
    for (const Vector3d& p : fixed_) {
        const Vector3d q = map.rotation.transpose() * (p - map.shift) / map.scale;
        if (const auto near = moving_.search().nearest({q.x(), q.y(), q.z()}))
            back.push_back(near->distance * map.scale);
    }
    return median_of(std::move(there)) * median_of(std::move(back));
}

}  // namespace treeform::detail::place
