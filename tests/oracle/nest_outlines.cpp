#include "nest_outlines.hpp"

#include <support/skip.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

#ifdef TREEFORM_NEST2D
#include <libnest2d/libnest2d.hpp>
#endif

namespace test {

#ifdef TREEFORM_NEST2D
namespace {

constexpr double unit = 1e6;  // coordinates of libnest2d in one of ours

using grid_point = std::pair<std::int64_t, std::int64_t>;

/// Clockwise, closed.
std::vector<grid_point> hull_from_above(const flat_points& part) {
    std::vector<grid_point> points;
    for (const auto& [x, y] : part)
        points.emplace_back(static_cast<std::int64_t>(x * unit),
                            static_cast<std::int64_t>(y * unit));
    std::sort(points.begin(), points.end());
    std::vector<grid_point> hull;
    const auto turn = [](const grid_point& a, const grid_point& b, const grid_point& c) {
        return static_cast<double>(b.first - a.first) * static_cast<double>(c.second - a.second) -
               static_cast<double>(b.second - a.second) * static_cast<double>(c.first - a.first);
    };
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const grid_point& p : points) {
            while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), p) >= 0.0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    hull.push_back(hull.front());
    return hull;
}

}  // namespace

std::optional<std::size_t> nest_outlines(const std::vector<flat_points>& parts, double length,
                                         double spacing) {
    std::vector<libnest2d::Item> items;
    for (const flat_points& part : parts) {
        libnest2d::PolygonImpl outline;
        for (const auto& [x, y] : hull_from_above(part)) outline.Contour.emplace_back(x, y);
        items.emplace_back(std::move(outline));
    }
    const auto side = static_cast<libnest2d::Coord>(length * unit);
    libnest2d::nest(items, libnest2d::Box(side, side),
                    static_cast<libnest2d::Coord>(spacing * unit));
    return static_cast<std::size_t>(std::count_if(
        items.begin(), items.end(), [](const libnest2d::Item& one) { return one.binId() == 0; }));
}
#else
std::optional<std::size_t> nest_outlines(const std::vector<flat_points>&, double, double) {
    skip_part("libnest2d was not found");
    return std::nullopt;
}
#endif

}  // namespace test
