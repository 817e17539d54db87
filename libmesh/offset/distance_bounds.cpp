#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/offset/distance_bounds.hpp>
#include <libmesh/offset/near_places.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::offset {
namespace {

constexpr int most_rounds = 10;

point3 middle(const point3& a, const point3& b) { return base::scaled(base::plus(a, b), 0.5); }

/// The distance to one face is convex, so it is greatest at a corner; that to the mesh is no more.
double bound_of(const triangle3& part, const triangle3& face) {
    double most = 0.0;
    for (const point3& p : part) most = std::max(most, closest_point(face, p).squared_distance);
    return std::sqrt(most);
}

}  // namespace

distance_bounds bounds_of_distance(mesh_view from, const prepared_mesh& mesh, double slack,
                                   const progress_callback& progress) {
    const nearness::closest_point_query& nearest = nearness::closest_point_query_of(mesh);
    std::vector<triangle3> parts(from.faces.size());
    for (std::uint32_t f = 0; f < parts.size(); ++f) parts[f] = base::triangle_of(from, f);
    double met = 0.0;      ///< by a point that was looked at
    double settled = 0.0;  ///< a bound for parts that are not looked at any more
    for (int round = 0; !parts.empty(); ++round) {
        std::vector<point3> centers(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto& [a, b, c] = parts[i];
            centers[i] = base::scaled(base::plus(base::plus(a, b), c), 1.0 / 3.0);
        }
        // The first round takes most of the time.
        const double begin = 1.0 - std::ldexp(1.0, -round);
        const auto found = near_places(nearest, centers, [&](double done) {
            return !progress || progress(begin + 0.5 * (1.0 - begin) * done);
        });
        if (found.size() != centers.size()) return {};
        std::vector<double> bounds(parts.size());
        for (std::size_t i = 0; i < parts.size(); ++i) {
            met = std::max(met, found[i]->distance);
            bounds[i] = bound_of(parts[i], base::triangle_of(mesh.indexed_view(), found[i]->face));
        }
        std::vector<triangle3> next;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (bounds[i] <= met + slack || round == most_rounds) {
                settled = std::max(settled, bounds[i]);
                continue;
            }
            const auto& [a, b, c] = parts[i];
            const point3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const triangle3& part : {triangle3{a, ab, ca}, triangle3{ab, b, bc},
                                          triangle3{ca, bc, c}, triangle3{ab, bc, ca}})
                next.push_back(part);
        }
        parts = std::move(next);
    }
    const prepared_mesh made = prepared_mesh::borrow(from);
    return {closest_pair(made, mesh)->distance, settled};
}

}  // namespace treeform::detail::offset
