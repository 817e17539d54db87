#include <libmesh/topology/is_manifold.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cstdint>
#include <utility>

namespace {

using tf::detail::topology::is_manifold;

/// A ring of `count` points with a point above and one below.
tf::mesh bipyramid(std::uint32_t count) {
    tf::mesh result;
    result.points.resize(count + 2);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        result.faces.push_back({i, next, count});
        result.faces.push_back({next, i, count + 1});
    }
    return result;
}

}  // namespace

TEST_CASE("is_manifold: closed surfaces, of no, one and several parts") {
    CHECK(is_manifold(tf::mesh{}));
    CHECK(is_manifold(test::box(1, 2, 3)));
    CHECK(is_manifold(test::together(test::box(1, 1, 1), test::ball(3, 1.0))));
    CHECK(is_manifold(bipyramid(3)));
}

TEST_CASE("is_manifold: not with a face missing, turned, twice, or without three corners") {
    const tf::mesh cube = test::box(1, 1, 1);
    tf::mesh open = cube;
    open.faces.pop_back();
    CHECK(!is_manifold(open));
    tf::mesh turned = cube;
    std::swap(turned.faces[3][0], turned.faces[3][1]);
    CHECK(!is_manifold(turned));
    tf::mesh twice = cube;
    twice.faces.push_back(cube.faces[5]);
    CHECK(!is_manifold(twice));
    tf::mesh flat = cube;
    flat.faces.push_back({0, 0, 1});
    CHECK(!is_manifold(flat));
}

TEST_CASE("is_manifold: not where two parts have a vertex or an edge in common") {
    const auto beside = [](const tf::point3& by) {
        tf::mesh other = test::box(1, 1, 1);
        for (tf::point3& p : other.points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
        return tf::join_equal_points(test::together(test::box(1, 1, 1), other));
    };
    CHECK(!is_manifold(beside({1, 1, 1})));
    CHECK(!is_manifold(beside({1, 1, 0})));
    CHECK(is_manifold(beside({2, 0, 0})));
}

TEST_CASE("is_manifold: points of more than 64 faces are not looked at") {
    CHECK(is_manifold(bipyramid(64)));
    CHECK(!is_manifold(bipyramid(65)));
}

TEST_CASE("is_manifold: few faces at a point and many, in one fan or in two") {
    for (std::uint32_t count = 3; count <= 20; ++count) {
        CAPTURE(count);
        const tf::mesh one = bipyramid(count);
        CHECK(is_manifold(one));
        tf::mesh two = test::together(one, one);
        for (tf::face& f : two.faces)
            for (std::uint32_t& corner : f)
                if (corner == 2 * count + 2) corner = count;  // the upper points are one
        const std::uint32_t last = 2 * count + 3;
        for (tf::face& f : two.faces)
            for (std::uint32_t& corner : f)
                if (corner == last) corner = 2 * count + 2;
        two.points.pop_back();
        CHECK(!is_manifold(two));
        tf::mesh turned = one;
        std::swap(turned.faces[0][0], turned.faces[0][1]);
        CHECK(!is_manifold(turned));
    }
}
