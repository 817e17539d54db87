#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/whole_boolean.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

/// A ball, with some corners moved: where it is higher than `height`, by rounding errors, so that
/// two of them all but lie on each other there; else to where others are not.
tf::mesh all_but_same(double height, double rest, test::random& source) {
    tf::mesh result = test::ball(4, 1.0);
    for (tf::point3& p : result.points) {
        const double c = std::cos(1.0), s = std::sin(1.0);
        p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
        const bool is_high = p.z > height;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] *= is_high ? 1.0 + static_cast<double>(source.below(5)) * 0x1p-52 : rest;
    }
    return result;
}

}  // namespace

TEST_CASE("mended parts: what is near is mended alone, to the solid that mending all gives") {
    std::uint64_t slivers = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        test::random source(seed);
        const double height = source.in(0.5, 0.95);
        const std::vector<tf::mesh> both{all_but_same(height, 1.0, source),
                                         all_but_same(height, 0.75, source)};
        for (const std::string text : {"a+b", "a-b", "a*b"}) {
            CAPTURE(seed);
            CAPTURE(text);
            const tf::boolean_result whole = test::whole_boolean(both, text);
            const tf::boolean_result result = tf::boolean({both[0], both[1]}, {text, 2});
            CHECK(result.certificate);
            CHECK(test::is_clean_solid(result.mesh));
            CHECK(tf::signed_volume(result.mesh) ==
                  doctest::Approx(tf::signed_volume(whole.mesh)).epsilon(1e-12));
            CHECK(result.certificate.max_displacement < 0x1p-47);
            CHECK(result.vanished_components == whole.vanished_components);
            for (const unsigned threads : {1U, 8U}) {
                const tf::thread_scope scope(threads);
                CHECK(tf::boolean({both[0], both[1]}, {text, 2}).mesh == result.mesh);
            }
            slivers += result.statistics.rounding_repairs;
        }
    }
    CHECK(slivers > 20);
}
