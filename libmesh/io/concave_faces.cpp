#include <libmesh/base/point_math.hpp>
#include <libmesh/io/concave_faces.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace treeform::detail::io {

namespace {

[[nodiscard]] point3 area_of(points_view m, const face& f) {
    const auto [a, b, c] = base::triangle_of(m, f);
    return base::cross(base::minus(b, a), base::minus(c, a));
}

}  // namespace

std::size_t count_concave_faces(const mesh_file& file) {
    constexpr double noise = 1e-6;  // of the face's area, which bounds what rounding turns over
    const std::vector<std::uint32_t>& stored = file.stored_face;
    std::size_t count = 0;
    std::vector<point3> areas;
    for (std::size_t first = 0; first < stored.size();) {
        std::size_t last = first + 1;
        while (last < stored.size() && stored[last] == stored[first]) ++last;
        areas.clear();
        point3 all{};
        for (std::size_t f = first; f < last && last - first > 1; ++f) {
            const point3 a = areas.emplace_back(area_of(file.mesh.points, file.mesh.faces[f]));
            all = base::plus(all, a);
        }
        const double whole = base::dot(all, all);
        for (const point3& a : areas)
            if (base::dot(a, all) < -noise * whole) {
                ++count;
                break;
            }
        first = last;
    }
    return count;
}

}  // namespace treeform::detail::io
