#pragma once
/// \file
/// Whether two surfaces bound the same solid, exactly, however each of them is cut into triangles.
///
/// A bounded solid is told by its boundary, the sum of its oriented faces. In a plane, such a sum
/// is told by the sum of the oriented edges around it, since no bounded part of a plane is without
/// edges. On a line, that in turn is told by the sum of its ends. So two surfaces are the same if
/// and only if, for each plane and each line in it, their ends add up to the same points as often.
/// Planes, lines and points are compared as rational numbers; nothing is rounded.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <gmpxx.h>
#include <support/rational_volume.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace test {

/// Triangles, each so often; below 0 for the other way round.
struct exact_chain {
    struct part {
        std::array<std::uint32_t, 3> corners{};
        std::uint32_t plane = 0;
        int count = 0;
    };
    std::vector<part> parts{};
};

/// Numbers for points and planes: equal ones have one number. All chains that are compared have
/// them from here.
class exact_numbers {
  public:
    std::uint32_t point(const tf::implicit_point& p) {
        std::array<double, 28> definition{};
        definition[0] = static_cast<double>(p.kind());
        const bool given = p.kind() == tf::implicit_point::origin::given;
        for (std::size_t i = 0; i < (given ? 1 : 9); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                definition[1 + 3 * i + k] = (given ? p.center() : p.definition()[i])[k] + 0.0;
        const auto [at, is_new] = point_of_definition_.try_emplace(definition, 0);
        if (!is_new) return at->second;
        const rational_point exact = rational(p);
        std::vector<std::uint32_t>& near =
            points_near_[{exact[0].get_d(), exact[1].get_d(), exact[2].get_d()}];
        const auto same = std::ranges::find_if(
            near, [&](std::uint32_t known) { return points_[known] == exact; });
        if (same != near.end()) return at->second = *same;
        near.push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(exact);
        return at->second = near.back();
    }

    /// \pre the triangle has an area
    std::uint32_t plane(const tf::triangle3& through) {
        std::array<double, 9> coordinates{};
        for (std::size_t i = 0; i < 9; ++i) coordinates[i] = through[i / 3][i % 3] + 0.0;
        const auto [at, is_new] = plane_of_triangle_.try_emplace(coordinates, 0);
        if (!is_new) return at->second;
        const rational_plane exact(rational(through[0]), rational(through[1]),
                                   rational(through[2]));
        const rational_point n = unit(exact.normal);
        const auto number = static_cast<std::uint32_t>(planes_.size());
        return at->second = planes_.try_emplace({n, dot(n, exact.at)}, number).first->second;
    }

    /// The line through two points: its direction, and where it is 0 along the first axis on which
    /// the direction is not.
    [[nodiscard]] std::pair<rational_point, rational_point> line(std::uint32_t a,
                                                                 std::uint32_t b) const {
        const rational_point& p = points_[a];
        const rational_point d = unit(minus(points_[b], p));
        const std::size_t k = first_axis(d);
        return {d, {p[0] - p[k] * d[0], p[1] - p[k] * d[1], p[2] - p[k] * d[2]}};
    }

  private:
    static std::size_t first_axis(const rational_point& d) {
        return d[0] != 0 ? 0U : d[1] != 0 ? 1U : 2U;
    }
    static rational_point unit(const rational_point& d) {
        const mpq_class& by = d[first_axis(d)];
        return {d[0] / by, d[1] / by, d[2] / by};
    }

    std::map<std::array<double, 28>, std::uint32_t> point_of_definition_{};
    std::map<std::array<double, 3>, std::vector<std::uint32_t>> points_near_{};
    std::vector<rational_point> points_{};
    std::map<std::array<double, 9>, std::uint32_t> plane_of_triangle_{};
    std::map<std::pair<rational_point, mpq_class>, std::uint32_t> planes_{};
};

/// Adds a triangle with an area that lies in the plane of `within`.
inline void add(exact_chain& chain, exact_numbers& numbers,
                const std::array<tf::implicit_point, 3>& corners, const tf::triangle3& within,
                int count = 1) {
    chain.parts.push_back(
        {{numbers.point(corners[0]), numbers.point(corners[1]), numbers.point(corners[2])},
         numbers.plane(within),
         count});
}

/// A triangle mesh as it is. \pre its triangles have an area
inline exact_chain chain_of(const tf::mesh& mesh, exact_numbers& numbers) {
    exact_chain chain;
    for (const auto& [a, b, c] : mesh.faces) {
        const tf::triangle3 t{mesh.points[a], mesh.points[b], mesh.points[c]};
        add(chain, numbers, {t[0], t[1], t[2]}, t);
    }
    return chain;
}

/// Whether two chains are the same surface.
inline bool is_same_surface(const exact_chain& a, const exact_chain& b,
                            const exact_numbers& numbers) {
    std::map<std::array<std::uint32_t, 3>, int> edges;  // of a plane, the lower end first
    for (const auto& [chain, sign] : {std::pair(&a, 1), std::pair(&b, -1)})
        for (const exact_chain::part& part : chain->parts)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t p = part.corners[k], q = part.corners[(k + 1) % 3];
                edges[{part.plane, std::min(p, q), std::max(p, q)}] +=
                    (p < q ? sign : -sign) * part.count;
            }
    std::map<std::tuple<std::uint32_t, std::pair<rational_point, rational_point>, std::uint32_t>,
             int>
        ends;
    for (const auto& [edge, count] : edges) {
        if (count == 0) continue;
        const auto& [plane, p, q] = edge;
        const auto line = numbers.line(p, q);
        ends[{plane, line, q}] += count;
        ends[{plane, line, p}] -= count;
    }
    return std::ranges::all_of(ends, [](const auto& end) { return end.second == 0; });
}

}  // namespace test
