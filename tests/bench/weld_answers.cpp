#include "bench/weld_answers.hpp"

#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace treeform::bench {
namespace {

double squared_distance_of(const point3& a, const point3& b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

std::size_t pairs_within(const std::vector<point3>& points, double tolerance) {
    const double half = 0.5000001 * tolerance;
    const auto tree = build(points, [&](const point3& p) {
        return aabb<double, 3>{{p.x - half, p.y - half, p.z - half},
                               {p.x + half, p.y + half, p.z + half}};
    });
    const auto counts =
        search_self<std::size_t>(tree, [&](std::size_t& count, std::uint32_t a, std::uint32_t b) {
            count += squared_distance_of(points[a], points[b]) <= tolerance * tolerance;
        });
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

}  // namespace

weld_quality quality_of(const weld_answer& answer, const std::vector<point3>& points,
                        double tolerance) {
    std::vector<point3> kept;
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (answer[i] == i) kept.push_back(points[i]);
        largest = std::max(largest, squared_distance_of(points[i], points[answer[i]]));
    }
    return {kept.size(), pairs_within(kept, tolerance), std::sqrt(largest)};
}

job weld_job(const shared_cloud& cloud, double tolerance,
             std::function<weld_answer(const std::vector<point3>&)> weld) {
    const auto known = std::make_shared<std::pair<const weld_answer*, weld_quality>>();
    const auto quality = [=](const weld_answer& answer) {
        if (known->first != &answer) *known = {&answer, quality_of(answer, *cloud, tolerance)};
        return known->second;
    };
    return make_job([=] { return weld(*cloud); },
                    [=](const weld_answer& answer) {
                        return static_cast<double>(quality(answer).missed_pairs);
                    },
                    [=](const weld_answer& answer) {
                        const weld_quality q = quality(answer);
                        return std::vector<figure>{{"kept", static_cast<double>(q.kept)},
                                                   {"missed", static_cast<double>(q.missed_pairs)},
                                                   {"displacement", q.largest_displacement}};
                    });
}

weld_answer weld_by_treeform(const std::vector<point3>& points, const weld_options& options,
                             detail::weld::neighbor_search search) {
    point_groups groups = detail::weld::find_groups("group_points", points, options, search);
    for (std::uint32_t& group : groups.group_of_point) group = groups.first_of_group[group];
    return std::move(groups.group_of_point);
}

weld_answer weld_by_rounding(const std::vector<point3>& points, double tolerance) {
    using row = std::pair<std::array<double, 3>, std::uint32_t>;
    std::vector<row> rows(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        rows[i] = {{std::floor(points[i].x / tolerance), std::floor(points[i].y / tolerance),
                    std::floor(points[i].z / tolerance)},
                   i};
    std::sort(rows.begin(), rows.end());
    weld_answer answer(points.size());
    std::size_t first = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].first != rows[first].first) first = i;
        answer[rows[i].second] = rows[first].second;
    }
    return answer;
}

}  // namespace treeform::bench
