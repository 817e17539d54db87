#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace {

/// The loop that a compiler turned into copies.
void round_all(std::vector<tf::point3>& points) {
    using tf::detail::base::nearest_float;
    for (tf::point3& p : points) p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

}  // namespace

TEST_CASE("nearest_float: what comes back has the 24 bits of a float, in loops of any length") {
    for (std::size_t n = 1; n < 20; ++n) {
        CAPTURE(n);
        std::vector<tf::point3> points(n, tf::point3{0.1, -0.2, 0.3});
        round_all(points);
        for (const tf::point3& p : points) {
            REQUIRE(p.x == 0x1.99999ap-4);
            REQUIRE(p.y == -0x1.99999ap-3);
            REQUIRE(p.z == 0x1.333334p-2);
        }
    }
}

TEST_CASE("nearest_float: ties go to even, floats stay, the ends of the range are those of float") {
    using tf::detail::base::nearest_float;
    CHECK(nearest_float(1.0 + 0x1p-24) == 1.0);
    CHECK(nearest_float(1.0 + 0x3p-24) == 1.0 + 0x1p-22);
    CHECK(nearest_float(1.0 + 0x1p-24 + 0x1p-52) == 1.0 + 0x1p-23);
    CHECK(nearest_float(0x1p-149) == 0x1p-149);
    CHECK(nearest_float(0x1p-151) == 0.0);
    CHECK(std::signbit(nearest_float(-0x1p-151)));
    constexpr double largest = std::numeric_limits<float>::max();
    CHECK(nearest_float(largest) == largest);
    CHECK(std::isinf(nearest_float(1e300)));
}
