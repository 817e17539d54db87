#include <treeform/mesh/point_location.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>

#include <array>
#include <cstddef>

namespace {

/// A box with a corner of one face moved off by `gap`.
tf::mesh cracked(double gap) {
    tf::mesh mesh = test::box(1, 1, 1);
    mesh.points.push_back(mesh.points[mesh.faces[0][1]]);
    mesh.points.back().x += gap;
    mesh.faces[0][1] = 8;
    return mesh;
}

}  // namespace

TEST_CASE("closing tolerance: the first that closes what is open") {
    const std::array steps{0.125, 0.25, 0.375};
    CHECK(tf::closing_tolerance(cracked(0.125), steps) == std::size_t{0});  // inclusive
    CHECK(tf::closing_tolerance(cracked(0.1875), steps) == std::size_t{1});
    CHECK(tf::closing_tolerance(cracked(0.375), steps) == std::size_t{2});
    CHECK_FALSE(tf::closing_tolerance(cracked(0.4375), steps));
    CHECK_FALSE(tf::closing_tolerance(cracked(0.125), {}));
}

TEST_CASE("closing tolerance: none where nothing is open, or all faces would be gone") {
    const std::array steps{0.125, 2.0};
    CHECK_FALSE(tf::closing_tolerance(test::box(1, 1, 1), steps));
    CHECK_FALSE(tf::closing_tolerance(cracked(0.0), steps));  // equal points are one
    CHECK_FALSE(tf::closing_tolerance({}, steps));
    tf::mesh open = test::box(1, 1, 1);
    open.faces.pop_back();
    CHECK_FALSE(tf::closing_tolerance(open, steps));
}
