#include <libmesh/base/used_points.hpp>
#include <libmesh/round/snap_nearby.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <cstdint>
#include <numeric>
#include <vector>

namespace {

tf::detail::round::joined_near join(const tf::mesh& mesh,
                                    const std::vector<std::uint8_t>& offending, double reach) {
    std::vector<std::uint32_t> source(mesh.faces.size());
    std::iota(source.begin(), source.end(), 0U);
    return tf::detail::round::snap_nearby(mesh, offending, {.reach = reach, .source = source});
}

}  // namespace

TEST_CASE("join near: corners go to the lowest that stays, of an offending face or next to one") {
    tf::mesh mesh;
    for (double x : {0.0, 4.0, 0.5, 1.2, 8.0, 4.5, 8.5}) mesh.points.push_back({x, 0, 0});
    mesh.points.push_back({0, 9, 0});
    mesh.points.push_back({0, 0, 9});
    // 2 goes to 0, so that 3 stays, and 6 to 4; 1 and 5 do not offend.
    mesh.faces = {{2, 7, 8}, {3, 7, 8}, {0, 7, 8}, {1, 7, 8}, {4, 7, 8}, {5, 7, 8}, {6, 7, 8}};
    const auto joined = join(mesh, {1, 1, 0, 0, 0, 0, 1}, 1.0);
    CHECK(tf::detail::base::used_points(9, joined.surface.faces) ==
          std::vector<std::uint32_t>{0, 1, 3, 4, 5, 7, 8});
    CHECK(joined.moved >= 0.5);
}

TEST_CASE("join near: a soup that is within reach of itself is gone") {
    test::random source(1);
    const tf::mesh mesh = test::random_soup(source, 20'000, 1.0);
    const std::vector<std::uint8_t> offending(mesh.faces.size(), 1);
    CHECK(join(mesh, offending, 6.0).surface.faces.empty());
}
