#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace {

constexpr bool kept = false, any = true;

const tf::mesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

}  // namespace

TEST_CASE("same triangles: numbers of points do not matter, coordinates and turns do") {
    CHECK(tf::same_triangles({}, {}, kept));
    CHECK_FALSE(tf::same_triangles(square, {}, any));
    tf::mesh soup{{}, {{0, 1, 2}, {3, 4, 5}}};
    for (const tf::face& f : square.faces)
        for (const std::uint32_t corner : f) soup.points.push_back(square.points[corner]);
    soup.points[0] = {-0.0, 0, -0.0};
    for (const auto order : {kept, any}) {
        CHECK(tf::same_triangles(square, soup, order));
        tf::mesh moved = soup;
        moved.points[4].x = std::numeric_limits<double>::epsilon() + 1;
        CHECK_FALSE(tf::same_triangles(square, moved, order));
        tf::mesh turned = soup;
        std::swap(turned.faces[0][0], turned.faces[0][1]);
        CHECK_FALSE(tf::same_triangles(square, turned, order));
        turned.points[0].x = std::numeric_limits<double>::quiet_NaN();
        CHECK_FALSE(tf::same_triangles(turned, turned, order));
    }
}

TEST_CASE("same triangles: faces in another order are the same only in any order") {
    const tf::mesh swapped{square.points, {{2, 3, 0}, {1, 2, 0}}};
    CHECK_FALSE(tf::same_triangles(square, swapped, kept));
    CHECK(tf::same_triangles(square, swapped, any));
    const tf::mesh twice{square.points, {{0, 1, 2}, {0, 1, 2}}};
    CHECK_FALSE(tf::same_triangles(square, twice, any));
}
