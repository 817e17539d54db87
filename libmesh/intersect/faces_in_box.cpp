#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace treeform {
namespace {

bool inside(const point3& p, const point3& min, const point3& max) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (p[axis] < min[axis] || p[axis] > max[axis]) return false;
    return true;
}

bool apart(const triangle3& t, const point3& min, const point3& max) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::max({t[0][axis], t[1][axis], t[2][axis]}) < min[axis]) return true;
        if (std::min({t[0][axis], t[1][axis], t[2][axis]}) > max[axis]) return true;
    }
    return false;
}

/// The six sides, two triangles each. A triangle without a corner in the box that meets the box
/// meets one of its sides.
std::array<triangle3, 12> sides(const point3& min, const point3& max) {
    const auto corner = [&](std::size_t i) {
        return point3{(i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                      (i & 4) != 0 ? max.z : min.z};
    };
    constexpr std::array<std::array<std::size_t, 4>, 6> quads{
        {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    std::array<triangle3, 12> result;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const auto& [a, b, c, d] = quads[q];
        result[2 * q] = {corner(a), corner(b), corner(c)};
        result[2 * q + 1] = {corner(a), corner(c), corner(d)};
    }
    return result;
}

}  // namespace

std::vector<std::uint32_t> faces_in_box(const mesh_ref& given, const point3& min,
                                        const point3& max) {
    const mesh_view mesh = given.view();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(min[axis]) || !std::isfinite(max[axis]) || min[axis] > max[axis])
            throw std::invalid_argument(
                "treeform::faces_in_box: the box needs finite corners, min <= max");

    detail::base::check_faces("faces_in_box", mesh.points.size(), mesh.faces);
    const std::array<triangle3, 12> walls = sides(min, max);
    const auto meets = [&](const face& f) {
        const triangle3 t = detail::base::triangle_of(mesh.points, f);
        if (apart(t, min, max)) return false;
        for (const point3& p : t)
            if (inside(p, min, max)) return true;
        return std::any_of(walls.begin(), walls.end(),
                           [&](const triangle3& wall) { return intersect(t, wall).count != 0; });
    };

    std::vector<std::vector<std::uint32_t>> found(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t f = begin; f < end; ++f)
                       if (meets(mesh.faces[f]))
                           found[chunk].push_back(static_cast<std::uint32_t>(f));
               });
    std::vector<std::uint32_t> result;
    for (const auto& part : found) result.insert(result.end(), part.begin(), part.end());
    return result;
}

}  // namespace treeform
