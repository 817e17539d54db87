#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/float_output.hpp>
#include <support/machine_parts.hpp>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

constexpr tf::precision to_float = tf::precision::float32;

tf::mesh small_gantry(std::uint64_t seed) {
    test::random source(seed);
    return test::gantry(source, 12, 1200);
}

std::vector<tf::mesh> small_gears(std::uint64_t seed) {
    test::random source(seed);
    return test::gears(source, 600);
}

}  // namespace

TEST_CASE("float output: shells that lie on each other but for less than a float step are united") {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const tf::mesh gantry = small_gantry(seed);
        test::check_floats(tf::resolve_self_intersections(gantry),
                           tf::resolve_self_intersections(gantry, tf::resolve_mode::outer,
                                                          {.precision = to_float}));
    }
}

TEST_CASE("float output: set operations on long thin triangles are certified") {
    for (const std::uint64_t seed : {1U, 2U})
        for (const char* formula : {"a+b", "a*b", "a-b"}) {
            CAPTURE(seed);
            CAPTURE(formula);
            const std::vector<tf::mesh> two = small_gears(seed);
            const std::vector<tf::mesh_view> views(two.begin(), two.end());
            test::check_floats(tf::boolean(views, {formula, 2}),
                               tf::boolean(views, {formula, 2}, {.precision = to_float}));
        }
}

TEST_CASE("float output: mending goes no further than the largest displacement allows") {
    const tf::mesh gantry = small_gantry(1);
    const auto with = [&](double most) {
        return tf::resolve_self_intersections(gantry, tf::resolve_mode::outer,
                                              {.precision = to_float, .max_displacement = most});
    };
    const auto as_rounded = with(0.0);
    CHECK(as_rounded.certificate.status == tf::status::not_certified);
    CHECK(as_rounded.certificate.max_displacement < 1e-6);
    CHECK(with(std::numeric_limits<double>::infinity()).certificate);
    // Grids are tried from 2^-21 of the largest coordinate on, which is below 16.
    CHECK(with(0.999 * 0x1p-19).certificate.max_displacement < 15.0 * 0x1p-19);
}

TEST_CASE("float output: a largest displacement that is negative or no number is refused") {
    const tf::mesh gantry = small_gantry(1);
    const tf::mesh clean = test::box(1, 1, 1);
    for (const double most : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_AS(static_cast<void>(tf::repair(clean, {.max_displacement = most})),
                        std::invalid_argument);
        CHECK_THROWS_AS(static_cast<void>(tf::resolve_self_intersections(
                            clean, tf::resolve_mode::remove, {.max_displacement = most})),
                        std::invalid_argument);
        CHECK_THROWS_AS(static_cast<void>(tf::resolve_self_intersections(
                            gantry, tf::resolve_mode::split, {.max_displacement = most})),
                        std::invalid_argument);
        CHECK_THROWS_AS(
            static_cast<void>(tf::boolean({gantry}, {"a", 1}, {.max_displacement = most})),
            std::invalid_argument);
        CHECK_THROWS_AS(static_cast<void>(tf::repair(gantry, {.max_displacement = most})),
                        std::invalid_argument);
    }
}
