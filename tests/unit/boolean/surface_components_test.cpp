#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::inside_out;
using test::moved;
using test::together;
using tf::detail::boolean::find_operand_edges;
using tf::detail::boolean::surface_components;
using tf::detail::boolean::winding_range;

/// A tube around a circle, or, with `turns` 2, around one that is run through twice.
tf::mesh torus(std::uint32_t turns = 1) {
    constexpr std::uint32_t along = 32, about = 12;
    tf::mesh result;
    for (std::uint32_t i = 0; i < along; ++i)
        for (std::uint32_t j = 0; j < about; ++j) {
            const double s = 2 * std::numbers::pi * turns * i / along;
            const double t = 2 * std::numbers::pi * j / about;
            const double r = 3 + std::cos(t);
            result.points.push_back({r * std::cos(s), r * std::sin(s), std::sin(t)});
        }
    for (std::uint32_t i = 0; i < along; ++i)
        for (std::uint32_t j = 0; j < about; ++j) {
            const auto at = [&](std::uint32_t k, std::uint32_t l) {
                return (k % along) * about + l % about;
            };
            result.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            result.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return result;
}

struct prepared {
    tf::mesh mesh;
    std::vector<std::uint32_t> operand;
    surface_components components;

    explicit prepared(tf::mesh given)
        : mesh(std::move(given)),
          operand(mesh.faces.size(), 0),
          components(mesh, operand, find_operand_edges(mesh, operand)) {}
};

}  // namespace

TEST_CASE("surface_components: pieces of an operand, and how often they may wind") {
    const tf::mesh crossed = [] {  // moved aside along the way, so that it crosses itself
        tf::mesh m = torus(2);
        for (std::size_t p = 0; p < m.points.size(); ++p)
            m.points[p].x += 0.3 * std::sin(std::numbers::pi * static_cast<double>(p) / 192.0);
        return m;
    }();
    tf::mesh all = together(ball(2, 1), moved(inside_out(ball(2, 1)), {5, 0, 0}));
    all = together(all, moved(torus(), {0, 20, 0}));
    all = together(all, moved(inside_out(torus()), {0, 20, 20}));
    all = together(all, moved(crossed, {0, 40, 0}));
    tf::mesh pierced =
        ball(2, 1);  // a corner pulled through the other side, where it is inside out
    pierced.points[0] = {-2, 0.01, 0.02};
    all = together(all, moved(pierced, {0, 60, 0}));
    const prepared p(all);
    REQUIRE(p.components.size() == 6);
    CHECK(p.components.range(0) == winding_range{0, 1});
    CHECK(p.components.range(1) == winding_range{-1, 0});
    CHECK(p.components.range(2) == winding_range{0, 1});
    CHECK(p.components.range(3) == winding_range{-1, 0});
    CHECK(p.components.range(4) == winding_range::unknown());  // too many faces meet
    CHECK(p.components.range(5) == winding_range{-1, 1});
}

TEST_CASE("surface_components: winding numbers that are not usual have a box") {
    // A ball with a corner pulled through the other side, where it is inside out.
    tf::mesh pierced = ball(8, 1);
    pierced.points[0] = {-1.5, 0.01, 0.02};
    const prepared p(together(together(pierced, moved(inside_out(pierced), {5, 0, 0})),
                              moved(torus(), {0, 9, 0})));
    REQUIRE(p.components.size() == 3);
    CHECK(p.components.range(0) == winding_range{-1, 1});
    CHECK(p.components.usual_range(0) == winding_range{0, 1});
    CHECK(p.components.range(1) == winding_range{-1, 1});
    CHECK(p.components.usual_range(1) == winding_range{-1, 0});
    CHECK(p.components.unusual_boxes(2).empty());
    CHECK(p.components.usual_range(2) == p.components.range(2));
    test::random source(4);
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
        const auto boxes = p.components.unusual_boxes(c);
        REQUIRE(!boxes.empty());
        std::size_t unusual = 0, in_no_box = 0;
        for (int i = 0; i < 20'000; ++i) {
            const auto& sampled = i % 2 == 0 ? p.components.box(c) : boxes.front();
            tf::point3 q;
            for (std::size_t k = 0; k < 3; ++k) q[k] = source.in(sampled.min[k], sampled.max[k]);
            const std::int64_t winding = p.components.winding_around(c, q);
            const bool in_box = std::ranges::any_of(boxes, [&](const auto& box) {
                for (std::size_t k = 0; k < 3; ++k)
                    if (q[k] < box.min[k] || q[k] > box.max[k]) return false;
                return true;
            });
            const winding_range usual = p.components.usual_range(c);
            if (winding < usual.low || winding > usual.high) {
                ++unusual;
                CHECK(in_box);
            }
            in_no_box += in_box ? 0U : 1U;
        }
        CHECK(unusual > 0);
        CHECK(in_no_box > 5'000);
    }
}

TEST_CASE("surface_components: the range of an operand's only component is not asked") {
    CHECK(prepared(ball(2, 1)).components.range(0) == winding_range::unknown());
}

TEST_CASE("surface_components: pieces that are closed together alone are one component") {
    // Two boxes without the same half of a wall between them, as one; and a third one.
    tf::mesh a = box(1, 1, 1);
    tf::mesh open = a;
    open.faces.erase(open.faces.begin());
    tf::mesh lid;
    lid.points = {a.points[a.faces[0][0]], a.points[a.faces[0][1]], a.points[a.faces[0][2]]};
    tf::point3 middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * lid.points[0][k] + 0.5 * lid.points[1][k];
    lid.points.push_back(middle);
    lid.faces = {{0, 3, 2}, {3, 1, 2}};  // an edge of the hole in two
    const tf::mesh joined =
        tf::join_equal_points(together(together(open, lid), moved(a, {9, 9, 9})));
    const prepared p(joined);
    REQUIRE(p.components.size() == 2);
    CHECK(p.components.faces(0).size() == 13);
    CHECK(p.components.range(0) == winding_range{0, 1});
}

TEST_CASE("surface_components: winding numbers of points") {
    const prepared p(together(torus(), moved(inside_out(ball(2, 1)), {3, 0, 0})));
    REQUIRE(p.components.size() == 2);
    test::random source(3);
    const tf::mesh outer = torus(), inner = moved(ball(2, 1), {3, 0, 0});
    const auto is_in = [](const tf::mesh& m, const tf::point3& q) {
        return tf::locate(m, q).where == tf::location::inside;
    };
    std::size_t inside = 0;
    for (int i = 0; i < 500; ++i) {
        const tf::point3 q{source.in(-5, 5), source.in(-5, 5), source.in(-1.5, 1.5)};
        CHECK(p.components.winding_around(0, q) == (is_in(outer, q) ? 1 : 0));
        CHECK(p.components.winding_around(1, q) == (is_in(inner, q) ? -1 : 0));
        inside += is_in(outer, q) ? 1U : 0U;
    }
    CHECK(inside > 50);
    // In line with corners and edges of the ball along every axis.
    CHECK(p.components.winding_around(1, {3, 0, 0}) == -1);
}
