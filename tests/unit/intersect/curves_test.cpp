#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using tf::point3;
using segment = std::array<point3, 2>;

tf::answer_lists<segment> curves_of(const tf::mesh& mesh) {
    return tf::intersection_curves(mesh, tf::self_intersections(mesh).pairs);
}

segment ordered(segment s) {
    const auto key = [](const point3& p) { return std::array{p.x, p.y, p.z}; };
    if (key(s[1]) < key(s[0])) std::swap(s[0], s[1]);
    return s;
}

}  // namespace

TEST_CASE("curves: two faces that cross meet in one segment") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto curves = curves_of(mesh);
    REQUIRE(curves.size() == 1);
    REQUIRE(curves[0].size() == 1);
    CHECK(ordered(curves[0][0]) == segment{{{1, 1, 0}, {1.5, 1, 0}}});
}

TEST_CASE("curves: a contact in a point is a segment without length") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto curves = curves_of(mesh);
    REQUIRE(curves.size() == 1);
    REQUIRE(curves[0].size() == 1);
    CHECK(curves[0][0] == segment{{{1, 1, 0}, {1, 1, 0}}});
}

TEST_CASE("curves: an overlap is outlined by a closed line") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
    const auto curves = curves_of(mesh);
    REQUIRE(curves.size() == 1);
    const auto sides = curves[0];
    REQUIRE(sides.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(sides[i][1] == sides[(i + 1) % 3][0]);
    std::vector<double> xs;
    for (const segment& side : sides) xs.push_back(side[0].x);
    std::sort(xs.begin(), xs.end());
    CHECK(xs == std::vector<double>{1, 1, 3});
}

TEST_CASE("curves: no pairs, no segments") {
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
    CHECK(curves_of(mesh).size() == 0);
    CHECK(curves_of(mesh).answers.empty());
}

TEST_CASE("curves: pairs that are none of the mesh are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {8, 0, 0}, {nan, 0, 0}},
                        {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 9}}};
    const auto says = [&](std::uint32_t face, bool paths) -> std::string {
        const std::vector<tf::face_pair> pairs{{0, 0}, {0, face}};
        try {
            if (paths)
                static_cast<void>(tf::intersection_paths(mesh, pairs));
            else
                static_cast<void>(tf::intersection_curves(mesh, pairs));
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return {};
    };
    CHECK(says(1, false).empty());
    CHECK(says(1, true) == "treeform::intersection_paths: pair 1 has face 1, which has no area");
    const std::vector<tf::face_pair> flat{{0, 1, tf::pair_kind::degenerate}};
    CHECK(tf::intersection_paths(mesh, flat).paths.empty());
    for (const bool paths : {false, true}) {
        CHECK(says(2, paths).ends_with("pair 1 has face 2, which has a corner that is not finite"));
        CHECK(
            says(3, paths).ends_with("pair 1 has face 3, which has a corner that is out of range"));
        CHECK(says(4, paths).ends_with("pair 1 has face 4, which is out of range"));
    }
}

TEST_CASE("curves: follow the order of the pairs on any number of threads") {
    tf::mesh mesh;
    constexpr std::uint32_t count = 120;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double s = i / double{count};
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), {{-1, s, -1}, {2, s, -1}, {0.5, s, 2}});
        mesh.points.insert(mesh.points.end(), {{s, -1, -1}, {s, 2, -1}, {s, 0.5, 2}});
        mesh.faces.push_back({first, first + 1, first + 2});
        mesh.faces.push_back({first + 3, first + 4, first + 5});
    }
    const auto pairs = tf::self_intersections(mesh).pairs;
    CHECK(pairs.size() == count * count);
    const auto curves = tf::intersection_curves(mesh, pairs);
    REQUIRE(curves.size() == pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [a, b, kind] = pairs[i];  // one across y, one across x, with a higher number
        const double y = mesh.points[mesh.faces[a % 2 == 0 ? a : b][0]].y;
        const double x = mesh.points[mesh.faces[a % 2 == 0 ? b : a][0]].x;
        REQUIRE(curves[i].size() == 1);
        for (const point3& p : curves[i][0])
            REQUIRE((std::abs(p.x - x) < 1e-12 && std::abs(p.y - y) < 1e-12 && p.z >= -1.0));
    }
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto again = tf::intersection_curves(mesh, pairs);
        CHECK(again.begin == curves.begin);
        CHECK(again.answers == curves.answers);
    }
}
