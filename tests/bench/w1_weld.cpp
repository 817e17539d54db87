/// \file
/// W1: points within a tolerance of each other become one, from arrays.

#include "bench/peers/cgal_merge_points.hpp"
#include "bench/peers/nanoflann_weld.hpp"
#include "bench/peers/versions.hpp"
#include "bench/weld_answers.hpp"
#include <treeform/mesh/weld.hpp>

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace treeform::bench {
namespace {

using detail::weld::neighbor_search;

constexpr std::array searches{std::pair{"treeform", neighbor_search::automatic},
                              std::pair{"treeform window", neighbor_search::window},
                              std::pair{"treeform cells", neighbor_search::cells},
                              std::pair{"treeform tree", neighbor_search::tree}};

contest moved_copies(std::size_t points, unsigned percent) {
    const auto given = [=] { return cloud_with_copies(points, percent); };
    contest contest{.name = fmt::format("{}_points/{}%", points, percent),
                    .size = [=] { return points; },
                    .long_runs = 3};
    for (const auto& [name, search] : searches)
        for (const unsigned threads : {1U, 2U})
            contest.contestants.push_back(
                {name, threads, [given, search = search] {
                     return weld_job(given(), reach, [=](const std::vector<point3>& cloud) {
                         return weld_by_treeform(cloud, {.tolerance = reach}, search);
                     });
                 }});
    contest.contestants.push_back({nanoflann_name(), 1, [=] {
                                       return weld_job(given(), reach, [](const auto& cloud) {
                                           return nanoflann_weld(cloud, reach);
                                       });
                                   }});
    contest.contestants.push_back({rounding_name, 1, [=] {
                                       return weld_job(given(), reach, [](const auto& cloud) {
                                           return weld_by_rounding(cloud, reach);
                                       });
                                   }});
    return contest;
}

/// A soup of triangles, of whose corners `percent` per cent equal others.
std::shared_ptr<const mesh> soup_with_copies(std::size_t points, unsigned percent) {
    const shared_cloud cloud = cloud_with_copies(points, percent);
    auto soup = std::make_shared<mesh>();
    soup->points = *cloud;
    // Every so many corners repeat one of the others.
    for (std::size_t i = 0; i < points; ++i)
        if (i % 100 < percent) soup->points[i] = (*cloud)[i * 7919 % points];
    for (std::uint32_t i = 0; i + 2 < points; i += 3) soup->faces.push_back({i, i + 1, i + 2});
    return soup;
}

contest equal_points_of_soup(std::size_t points, unsigned percent) {
    const auto given = [=] { return soup_with_copies(points, percent); };
    contest contest{.name = fmt::format("{}_points/{}%/equal", points, percent),
                    .size = [=] { return points; },
                    .long_runs = 3};
    for (const unsigned threads : {1U, 2U})
        contest.contestants.push_back({"treeform", threads, [=] {
                                           return make_job([soup = given()] {
                                               return group_points(soup->points, {}).joined(*soup);
                                           });
                                       }});
    contest.contestants.push_back(
        {cgal_name(), 1, [=] {
             const auto soup = given();
             return cgal_merge_points(*soup, find_equal_points(soup->points).first_of_group.size());
         }});
    return contest;
}

}  // namespace

void weld(const setting& setting, const contest_visitor& visit) {
    std::vector<std::size_t> sizes{1'000'000, 10'000'000};
    if (setting.effort == effort::quick) sizes = {100'000, 1'000'000};
    if (setting.effort == effort::tiny) sizes = {1'000};
    for (const std::size_t size : sizes) {
        for (const unsigned percent : {10U, 30U, 50U}) visit(moved_copies(size, percent));
        visit(equal_points_of_soup(size, 50));
    }
}

}  // namespace treeform::bench
