#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/arrange/wanted_meetings.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

namespace {

using tf::detail::arrange::keep_wanted;
using tf::detail::intersect::mesh_meetings;
using box3 = tf::aabb<double, 3>;

/// Two balls through each other, and what they have in common: a ring about the first axis.
struct two_balls {
    tf::mesh mesh =
        test::together(test::ball(3, 1.0), test::moved(test::ball(3, 1.0), {0.7, 0.1, 0}));
    mesh_meetings met =
        tf::detail::intersect::meetings_of(mesh, tf::self_intersections(mesh).pairs);
};

constexpr auto is_low = [](const box3& box) { return box.min[2] <= -0.25; };

/// The lowest approximate coordinate of what two faces have in common.
double bottom_of(const two_balls& balls, const tf::detail::intersect::meeting& m) {
    double low = 9.0;
    for (const auto& end : std::span(m.ends).first(m.count))
        low =
            std::min(low, end.point < balls.mesh.points.size()
                              ? balls.mesh.points[end.point].z
                              : balls.met.points[end.point - balls.mesh.points.size()].center().z);
    return low;
}

}  // namespace

TEST_CASE("wanted meetings: all, none, and those with a part in wanted boxes") {
    const two_balls balls;
    const std::size_t all = balls.met.meetings.size();
    REQUIRE(all > 40);
    two_balls same;
    keep_wanted(same.met, same.mesh.points, [](const box3&) { return true; });
    CHECK(same.met.meetings.size() == all);
    CHECK(same.met.names == balls.met.names);

    two_balls none;
    keep_wanted(none.met, none.mesh.points, [](const box3&) { return false; });
    CHECK(none.met.meetings.empty());
    CHECK(none.met.names.empty());
    CHECK(none.met.points.empty());

    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (const auto& m : balls.met.meetings)
        if (bottom_of(balls, m) <= -0.25) expected.emplace_back(m.a, m.b);
    two_balls some;
    keep_wanted(some.met, some.mesh.points, is_low);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> kept;
    for (const auto& m : some.met.meetings) kept.emplace_back(m.a, m.b);
    CHECK(kept == expected);
    CHECK(kept.size() > all / 5);
    CHECK(kept.size() < all / 2);
}

TEST_CASE("wanted meetings: names are those that are still in use, and of the same points") {
    const two_balls balls;
    two_balls some;
    keep_wanted(some.met, some.mesh.points, is_low);
    REQUIRE(some.met.names.size() == some.met.points.size());
    CHECK(some.met.names.size() < balls.met.names.size());
    CHECK(std::is_sorted(some.met.names.begin(), some.met.names.end()));
    std::set<std::uint32_t> used;
    for (const auto& m : some.met.meetings) {
        const auto before =
            std::find_if(balls.met.meetings.begin(), balls.met.meetings.end(),
                         [&](const auto& other) { return other.a == m.a && other.b == m.b; });
        REQUIRE(before != balls.met.meetings.end());
        for (std::size_t k = 0; k < m.count; ++k) {
            const std::uint32_t now = m.ends[k].point, was = before->ends[k].point;
            if (now < some.mesh.points.size()) {
                CHECK(now == was);
                continue;
            }
            const std::size_t given = some.mesh.points.size();
            used.insert(now);
            CHECK(some.met.names[now - given] == balls.met.names[was - given]);
            CHECK(tf::equal(some.met.points[now - given], balls.met.points[was - given]));
        }
    }
    CHECK(used.size() == some.met.names.size());
}

TEST_CASE("arrange where: faces stay whole where only their boxes are in a wanted one") {
    // They cross at x = 1 to 2; their common box is x = 0 to 2.
    const tf::mesh crossing{
        {{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {0, -1, -1}, {2, 0, -0.5}, {2, 0, 1.5}},
        {{0, 1, 2}, {3, 4, 5}}};
    const auto arranged = [&](double from, double to) {
        box3 wanted;
        wanted.include(tf::point3{from, -5, -5});
        wanted.include(tf::point3{to, 5, 5});
        return tf::detail::arrange::arrange_where(
            crossing, [&](const box3& box) { return overlaps(box, wanted); }, {});
    };
    const auto all = arranged(0, 2), beside = arranged(0, 0.5), away = arranged(-2, -1);
    CHECK(all.pairs == 1);
    CHECK(all.cut.faces.size() > 2);
    CHECK(all.cut.constructed.size() > 0);
    for (const auto* whole : {&beside, &away}) {
        CHECK(whole->pairs == 0);
        CHECK(whole->cut.faces == crossing.faces);
        CHECK(whole->cut.constructed.empty());
    }
}
