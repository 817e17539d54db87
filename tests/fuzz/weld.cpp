/// \file
/// Welding of small clouds against the rules as they read, by every search.

#include "bytes.hpp"
#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <support/brute_weld.hpp>

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::fuzz::require;
    tf::fuzz::bytes in(data, size);
    tf::weld_options options;
    options.chain = in.below(2) != 0;
    const auto search = static_cast<tf::detail::weld::neighbor_search>(in.below(4));
    options.tolerance = std::abs(in.coordinate());
    std::vector<tf::point3> points;
    while (!in.empty() && points.size() < 100) points.push_back(in.point());

    const auto linked = [&](std::uint32_t i, std::uint32_t k) {
        return tf::test::brute_within(points[i], points[k], options.tolerance);
    };
    const auto expected = !options.chain ? tf::test::brute_leaders(points, linked)
                                         : tf::test::brute_chains(points, linked);
    const tf::point_groups found =
        tf::detail::weld::find_groups("group_points", points, options, search);
    require(found.group_of_point.size() == points.size(), "a group for each point");
    for (std::size_t i = 0; i < points.size(); ++i)
        require(found.first_of_group[found.group_of_point[i]] == expected[i], "the group's first");
    return 0;
}
