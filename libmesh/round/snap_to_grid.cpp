#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/round/cancelled_faces.hpp>
#include <libmesh/round/snap_to_grid.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace treeform::detail::round {
namespace {

/// -0 is 0 here.
double nearest_multiple(double x, double step) { return std::nearbyint(x / step) * step + 0.0; }

bool is_before(const point3& p, const point3& q) {
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
}

/// The places that corners of offending faces come to, ascending.
std::vector<point3> places_of(mesh_view mesh, std::span<const std::uint8_t> offending,
                              double step) {
    std::vector<std::uint8_t> is_corner(mesh.points.size(), 0);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        if (offending[f] != 0)
            for (const std::uint32_t corner : mesh.faces[f]) is_corner[corner] = 1;
    std::vector<point3> places;
    for (std::size_t p = 0; p < is_corner.size(); ++p)
        if (is_corner[p] != 0) places.push_back(on_grid(mesh.points[p], step));
    std::ranges::sort(places, is_before);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

/// Moves the points that come to one of the places. How far at most, in each coordinate.
double move_points(std::vector<point3>& points, const std::vector<point3>& places, double step) {
    std::vector<double> moves(chunk_count(points.size(), light_grain) + 1, 0.0);
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t p = begin; p < end; ++p) {
            const point3 there = on_grid(points[p], step);
            if (!std::ranges::binary_search(places, there, is_before)) continue;
            moves[c] = std::max(moves[c], base::largest_of(base::minus(there, points[p])));
            points[p] = there;
        }
    });
    return *std::ranges::max_element(moves);
}

}  // namespace

point3 on_grid(const point3& p, double step) {
    return {nearest_multiple(p.x, step), nearest_multiple(p.y, step), nearest_multiple(p.z, step)};
}

joined_near snap_to_grid(mesh_view mesh, std::span<const std::uint8_t> offending,
                         const grid_joint& how) {
    joined_near result;
    std::vector<point3>& points = result.surface.points;
    points.assign(mesh.points.begin(), mesh.points.end());
    result.moved = move_points(points, places_of(mesh, offending, how.step), how.step);
    const auto equal = weld::few_equal_points(points);
    std::vector<face>& faces = result.surface.faces;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        face now = mesh.faces[f];
        if (equal)
            for (std::uint32_t& corner : now)
                corner = equal->first_of_new[equal->new_of_old[corner]];
        if (!base::has_three_corners(now)) continue;
        faces.push_back(now);
        result.face_of.push_back(f);
    }
    if (how.of_operands) return result;
    const std::vector<std::uint8_t> gone = cancelled_faces(faces, how.solid);
    std::size_t kept = 0;
    for (std::size_t f = 0; f < gone.size(); ++f) {
        if (gone[f] != 0) continue;
        faces[kept] = faces[f];
        result.face_of[kept++] = result.face_of[f];
    }
    faces.resize(kept);
    result.face_of.resize(kept);
    return result;
}

}  // namespace treeform::detail::round
