#include <libmesh/intersect/meetings.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cstddef>

namespace {

using box3 = tf::aabb<double, 3>;

bool is_in(const box3& inner, const box3& outer) {
    for (std::size_t k = 0; k < 3; ++k)
        if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
    return true;
}

}  // namespace

TEST_CASE("box of a meeting: around the points of both faces, and tight") {
    const tf::mesh balls =
        test::together(test::ball(3, 1.0), test::moved(test::ball(3, 1.0), {0.7, 0.1, 0}));
    const auto pairs = tf::self_intersections(balls).pairs;
    const auto met = tf::detail::intersect::meetings_of(balls, pairs);
    REQUIRE(pairs.size() > 40);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        box3 points;
        for (std::size_t k = 0; k < met.meetings[i].count; ++k) {
            const auto p = met.meetings[i].ends[k].point;
            points.include(p < balls.points.size() ? balls.points[p]
                                                   : met.points[p - balls.points.size()].center());
        }
        const box3 box = tf::detail::intersect::box_of_meeting(balls, pairs[i]);
        CHECK(is_in(points, box));
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(box.min[k] >= points.min[k] - 1e-12);
            CHECK(box.max[k] <= points.max[k] + 1e-12);
        }
    }
}

TEST_CASE("box of a meeting: at corners it is that point, of faces in one plane what they share") {
    const tf::mesh touching{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}, {1, 1, 1}, {0, 1, 1}},
                            {{0, 1, 2}, {3, 4, 5}}};
    const box3 at = tf::detail::intersect::box_of_meeting(touching, {0, 1, {}});
    CHECK(at.min[0] == 0.5);
    CHECK(at.max[0] == 0.5);
    CHECK(at.max[2] == 0.0);
    const tf::mesh flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {9, 1, 0}, {1, 9, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const box3 shared = tf::detail::intersect::box_of_meeting(flat, {0, 1, {}});
    CHECK(shared.min[0] == doctest::Approx(1.0));
    CHECK(shared.max[0] == doctest::Approx(3.0));
    CHECK(shared.max[1] == doctest::Approx(3.0));
}
