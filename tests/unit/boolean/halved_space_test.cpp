#include <libmesh/boolean/halved_space.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace {

using tf::detail::boolean::halved_space;
using box3 = tf::aabb<double, 3>;
using node = halved_space::node;

box3 around(const tf::point3& p, double off = 0.0) {
    box3 box;
    box.include(tf::point3{p.x - off, p.y - off, p.z - off});
    box.include(tf::point3{p.x + off, p.y + off, p.z + off});
    return box;
}

/// Halves a box down to leaves, some of which are decided.
void halve(test::random& source, halved_space& space, std::size_t at, const box3& box, int levels) {
    if (levels == 0 || source.below(6) == 0) {
        space.nodes[at].axis = source.below(2) == 0 ? node::decided : node::undecided;
        return;
    }
    const std::size_t axis = source.below(3);
    const double middle = 0.5 * (box.min[axis] + box.max[axis]);
    const auto below = static_cast<std::uint32_t>(space.nodes.size());
    space.nodes[at] = {static_cast<std::uint8_t>(axis), middle, below};
    space.nodes.resize(below + 2);
    box3 lower = box, upper = box;
    lower.max[axis] = upper.min[axis] = middle;
    halve(source, space, below, lower, levels - 1);
    halve(source, space, below + 1, upper, levels - 1);
}

halved_space random_space(test::random& source) {
    halved_space space;
    space.box = around({0.0, 0.0, 0.0}, 1.0);
    space.nodes.resize(1);
    halve(source, space, 0, space.box, 7);
    return space;
}

}  // namespace

TEST_CASE("halved space: a triangle leaves undecided boxes, or is within them") {
    test::random source(71);
    std::size_t leaves = 0, within = 0;
    for (int round = 0; round < 200; ++round) {
        const halved_space space = random_space(source);
        for (int i = 0; i < 50; ++i) {
            const double size = source.in(0.01, 1.0);
            std::array<tf::point3, 3> t;
            const tf::point3 middle{source.in(-0.9, 0.9), source.in(-0.9, 0.9),
                                    source.in(-0.9, 0.9)};
            for (tf::point3& p : t)
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = std::clamp(middle[k] + source.in(-size, size), -1.0, 1.0);
            const std::array<box3, 3> corners{around(t[0]), around(t[1]), around(t[2])};
            const bool is_within = space.is_within_undecided(corners);
            const bool does_leave = space.leaves_undecided(corners);
            CHECK(is_within != does_leave);
            leaves += does_leave ? 1 : 0;
            within += is_within ? 1 : 0;
            for (int s = 0; s < 20 && is_within; ++s) {
                const double u = source.in(0.0, 1.0), v = source.in(0.0, 1.0 - u);
                tf::point3 p;
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = t[0][k] + u * (t[1][k] - t[0][k]) + v * (t[2][k] - t[0][k]);
                CHECK(space.reaches_undecided(around(p, 1e-14)));
            }
        }
    }
    CHECK(leaves > 1000);
    CHECK(within > 1000);
}

TEST_CASE("halved space: what is on the boundary of an undecided box does not leave it") {
    halved_space space;
    space.box = around({0.0, 0.0, 0.0}, 1.0);
    space.nodes = {{0, 0.0, 1}, {node::undecided}, {node::decided}};
    const auto leaves = [&](double x, double off) {
        return space.leaves_undecided(
            {around({-0.5, 0, 0}, off), around({x, 1, 0}, off), around({x, 0, 1}, off)});
    };
    CHECK(!leaves(-0.1, 0.0));
    CHECK(!leaves(0.0, 0.0));
    CHECK(leaves(0.25, 0.0));
    CHECK(leaves(0.25, 1e-3));
    CHECK(!leaves(0.25, 0.5));  // it may be anywhere there
}
