#include <libmesh/base/point_math.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/weld/moves.hpp>
#include <libmesh/weld/reach.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

/// From where to where a point went.
struct move {
    point3 from{};
    point3 to{};

    [[nodiscard]] bool further_than(const move& other) const {
        const order known = compare_rounded(rounded_squared_distance(from, to),
                                            rounded_squared_distance(other.from, other.to));
        if (known != order::unsure) return known == order::more;
        return compare_distance(from, to, other.from, other.to) > 0;
    }

    /// By bisection: doubles that are not negative are ordered as their bits.
    [[nodiscard]] double distance_above() const {
        std::uint64_t low = 0;
        auto high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
        while (low < high) {
            const std::uint64_t middle = low + (high - low) / 2;
            const point3 reach{std::bit_cast<double>(middle), 0.0, 0.0};
            if (compare_distance(from, to, {}, reach) <= 0)
                high = middle;
            else
                low = middle + 1;
        }
        return std::bit_cast<double>(low);
    }
};

plane_points corners_of(mesh_view mesh, const face& f) {
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

bool finite(const plane_points& p) {
    return detail::base::is_finite(p.a) && detail::base::is_finite(p.b) &&
           detail::base::is_finite(p.c);
}

}  // namespace

double max_displacement(points_view points, std::span<const std::uint32_t> group_of_point,
                        points_view places) {
    std::vector<move> furthest(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i) {
            const move mine{points[i], places[group_of_point[i]]};
            if (mine.from == mine.to || !detail::base::is_finite(mine.from)) continue;
            if (mine.further_than(furthest[c])) furthest[c] = mine;
        }
    });
    move found;
    for (const move& m : furthest)
        if (m.further_than(found)) found = m;
    return found.distance_above();
}

bool is_flipped(const plane_points& before, const plane_points& after) {
    if (before.a == after.a && before.b == after.b && before.c == after.c) return false;
    return finite(before) && finite(after) && normal_dot(before, after) < 0;
}

std::uint64_t count_flipped(mesh_view before, mesh_view after,
                            std::span<const std::uint32_t> face_of_new) {
    std::vector<std::uint64_t> found(chunk_count(after.faces.size(), light_grain), 0);
    for_chunks(after.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t i = begin; i < end; ++i)
                       found[c] += is_flipped(corners_of(before, before.faces[face_of_new[i]]),
                                              corners_of(after, after.faces[i]))
                                       ? 1
                                       : 0;
               });
    std::uint64_t total = 0;
    for (const std::uint64_t n : found) total += n;
    return total;
}

}  // namespace treeform::detail::weld
