#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using tf::faces_in_box;
using tf::point3;
using found = std::vector<std::uint32_t>;

found meets(const point3& a, const point3& b, const point3& c, const point3& low,
            const point3& high) {
    const tf::mesh one{{a, b, c}, {{0, 1, 2}}};
    return faces_in_box(one, low, high);
}

const found yes{0};
const found no{};

}  // namespace

TEST_CASE("faces_in_box: a corner inside, an edge through, a face around") {
    CHECK(meets({0.5, 0.5, 0.5}, {9, 9, 9}, {9, 8, 9}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({-1, 0.5, 0.5}, {2, 0.5, 0.5}, {0.5, 9, 9}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({-9, -9, 0.5}, {9, -9, 0.5}, {0, 9, 0.5}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({2, 2, 2}, {3, 2, 2}, {2, 3, 2}, {0, 0, 0}, {1, 1, 1}) == no);
}

TEST_CASE("faces_in_box: contact counts, one step beyond does not") {
    const double beyond = std::nextafter(1.0, 2.0);
    CHECK(meets({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({beyond, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 0, 0}, {1, 1, 1}) == no);
    // the plane x + y = 2 touches the edge x = y = 1 of the box
    CHECK(meets({0, 2, 0.5}, {2, 0, 0.5}, {1, 1, 5}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({0, 2, 0.5}, {2, std::nextafter(0.0, 1.0), 0.5}, {1.25, 1.25, 5}, {0, 0, 0},
                {1, 1, 1}) == no);
}

TEST_CASE("faces_in_box: overlapping boxes are not enough") {
    CHECK(meets({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3, 0}, {4, 4, 0}) == no);
    CHECK(meets({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 2, 0}, {4, 4, 0}) == yes);
}

TEST_CASE("faces_in_box: the box may be a rectangle, a line or a point") {
    CHECK(meets({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}) == yes);
    CHECK(meets({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}) == yes);
    CHECK(meets({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3, 0}, {3, 3, 0}) == no);
}

TEST_CASE("faces_in_box: a degenerate face is the segment or point it is") {
    CHECK(meets({-1, 0.5, 0.5}, {0, 0.5, 0.5}, {2, 0.5, 0.5}, {0, 0, 0}, {1, 1, 1}) == yes);
    CHECK(meets({2, 2, 2}, {2, 2, 2}, {2, 2, 2}, {0, 0, 0}, {1, 1, 1}) == no);
    CHECK(meets({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}) == yes);
}

TEST_CASE("faces_in_box: a box that cannot be meant is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh none;
    CHECK_THROWS_AS(static_cast<void>(faces_in_box(none, {1, 0, 0}, {0, 1, 1})),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(faces_in_box(none, {nan, 0, 0}, {0, 1, 1})),
                    std::invalid_argument);
}

TEST_CASE("faces_in_box: agrees with sampling on random faces") {
    std::mt19937_64 engine(11);
    const auto number = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0; };
    tf::mesh soup;
    for (std::uint32_t f = 0; f < 2000; ++f) {
        for (int i = 0; i < 3; ++i) soup.points.push_back({number(), number(), number()});
        soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const point3 low{-0.3, -0.2, -0.1};
    const point3 high{0.3, 0.2, 0.4};
    const found in = faces_in_box(soup, low, high);
    std::vector<bool> is_in(soup.faces.size(), false);
    for (const std::uint32_t f : in) is_in[f] = true;
    CHECK(in.size() > 100);
    CHECK(in.size() < 1900);
    for (std::uint32_t f = 0; f < soup.faces.size(); ++f) {
        bool sampled = false;  // a sample inside proves that the face meets the box
        for (int i = 0; i <= 20 && !sampled; ++i)
            for (int j = 0; i + j <= 20 && !sampled; ++j) {
                point3 p;
                bool inside = true;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    p[axis] = (i * soup.points[3 * f][axis] + j * soup.points[3 * f + 1][axis] +
                               (20 - i - j) * soup.points[3 * f + 2][axis]) /
                              20.0;
                    inside = inside && p[axis] > low[axis] + 1e-9 && p[axis] < high[axis] - 1e-9;
                }
                sampled = inside;
            }
        if (sampled) REQUIRE(is_in[f]);
    }
}

TEST_CASE("select_faces: keeps the order of faces and points, and only the points in use") {
    const tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
                        {{4, 1, 0}, {1, 2, 3}, {3, 1, 4}}};
    const std::vector<std::uint32_t> chosen{2, 1};
    const tf::mesh part = tf::submesh(mesh, chosen).mesh;
    CHECK(part.points == std::vector<point3>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
    CHECK(part.faces == std::vector<tf::face>{{2, 0, 3}, {0, 1, 2}});
    CHECK(tf::submesh(mesh, {}).mesh.points.empty());
}

TEST_CASE("bounding_box: holds the finite points, and there may be none") {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(tf::bounding_box({}).has_value());
    CHECK_FALSE(tf::bounding_box(std::vector<point3>{{nan, 0, 0}, {0, inf, 0}}).has_value());
    const auto box = tf::bounding_box(std::vector<point3>{{1, 2, 3}, {nan, 9, 9}, {-1, 5, 3}});
    CHECK(box == tf::box3{{-1, 2, 3}, {1, 5, 3}});
    CHECK(tf::box3{{0, 0, 0}, {3, 4, 12}}.diagonal() == 13.0);
    const double most = std::numeric_limits<double>::max();
    CHECK(tf::box3{{-most, 0, 0}, {most, 0, 0}}.diagonal() == most);
}
