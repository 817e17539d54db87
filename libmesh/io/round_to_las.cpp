#include <libmesh/io/las_plan.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace treeform {

double round_to_las(mesh_file& file, const write_options& options) {
    std::vector<point3>& points = file.mesh.points;
    if (!file.las) {
        file.las.emplace();
        detail::io::choose_las_grid(*file.las, points, detail::io::las_grid_wish_of(options));
    } else {
        detail::io::las_grid_wish_of(options).put(*file.las);
    }
    const detail::io::las_grid grid{file.las->scale, file.las->offset};
    std::vector<double> moved(chunk_count(points.size(), light_grain), 0.0);
    std::vector<std::size_t> beyond(moved.size(), points.size());
    for_chunks(points.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t i = begin; i < end; ++i)
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                           double& x = points[i][axis];
                           if (!std::isfinite(x)) continue;
                           const double step = detail::io::nearest_step(grid, axis, x);
                           if (!detail::io::is_las_step(step)) {
                               beyond[chunk] = std::min(beyond[chunk], i);
                               continue;
                           }
                           const double to = grid.coordinate(axis, static_cast<std::int32_t>(step));
                           moved[chunk] = std::max(moved[chunk], std::abs(to - x));
                           x = to;
                       }
               });
    for (const std::size_t i : beyond)
        if (i < points.size())
            throw io_error("point " + std::to_string(i) +
                           ": a coordinate needs more than 32 bits at this scale");
    return moved.empty() ? 0.0 : *std::max_element(moved.begin(), moved.end());
}

}  // namespace treeform
