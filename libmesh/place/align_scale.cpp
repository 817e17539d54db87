#include <libmesh/place/align_scale.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace treeform::detail::place {
namespace {

constexpr std::size_t most_asked = 2000;  ///< of the fixed points

double middle_of(std::vector<double> distances) {
    if (distances.empty()) return 0.0;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

}  // namespace

both_ways::both_ways(const moving_points& few, const align_frame& frame, mesh_view fixed)
    : few_(few) {
    std::vector<point3> points;
    for (const Vector3d& p : few.points) points.push_back(to_point(p));
    moving_ = searched_cloud(std::move(points));
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
    return middle_of(std::move(there)) * middle_of(std::move(back));
}

}  // namespace treeform::detail::place
