#include <libmesh/arrange/planar_box.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <array>
#include <vector>

TEST_CASE("planar box: the triangle around it strictly holds points that differ by ulps") {
    // Of points this near each other, the ulp of one coordinate may exceed the extent of the other.
    const std::vector<std::vector<tf::point3>> clouds{
        {{0, 0x1.519p-25, -0x1.b84p-27}, {0, 0x1.519p-25, -0x1.b840000000001p-27}},
        {{0, 0x1p300, 0x1p-300}, {0, 0x1p300, -0x1p-300}},
        {{0, 1, 1}},
        {{0, 0, 0}, {0, 0x1p-1074, 0}},
        {{0, -3, 5}, {0, 4, -7}}};
    for (const std::vector<tf::point3>& points : clouds)
        for (const int orientation : {1, -1}) {
            treeform::detail::arrange::planar_box box(0);
            for (const tf::point3& p : points) box.include(p);
            const std::array<tf::point3, 3> around = box.triangle_around(orientation);
            const tf::point3 above{static_cast<double>(orientation), 0, 0};
            const int outside = tf::orient3d(around[0], around[1], around[2], above);
            CHECK(outside != 0);
            for (const tf::point3& p : points)
                for (std::size_t i = 0; i < 3; ++i)
                    CHECK(tf::orient3d(around[i], around[(i + 1) % 3], p, above) == outside);
        }
}
