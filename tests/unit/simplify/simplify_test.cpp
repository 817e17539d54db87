/// \file
/// Fewer faces within a distance: solids stay solids, nothing meets, both distances hold.

#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/simplify.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace {

/// A closed torus of n by n quads.
tf::mesh fine_torus(std::uint32_t n) {
    tf::mesh made;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * j / n;
            const double r = 3.0 + std::cos(v);
            made.points.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
            const std::uint32_t k = (i + 1) % n, l = (j + 1) % n;
            made.faces.push_back({i * n + j, k * n + j, k * n + l});
            made.faces.push_back({i * n + j, k * n + l, i * n + l});
        }
    return made;
}

}  // namespace

TEST_CASE("A torus stays a clean solid, within the distance both ways") {
    const tf::mesh torus = fine_torus(40);
    for (const double distance : {0.0, 0.01, 0.1}) {
        const tf::simplify_result made = tf::simplify(torus, distance);
        MESSAGE(distance << ": " << made.mesh.faces.size() << " faces");
        CHECK(test::is_clean_solid(made.mesh));
        CHECK(made.there_at_most <= distance);
        CHECK(made.back_at_most <= distance);
        const auto far = tf::deviation(torus, made.mesh);
        REQUIRE(far);
        CHECK(far->there.sampled <= made.there_at_most + 1e-12);
        CHECK(far->back->sampled <= made.back_at_most + 1e-12);
        if (distance > 0.05) CHECK(made.mesh.faces.size() < torus.faces.size() / 4);
    }
}

TEST_CASE("A distance that is no distance is refused") {
    CHECK_THROWS_AS((void)tf::simplify(fine_torus(4), -1.0), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::simplify(fine_torus(4), std::nan("")), std::invalid_argument);
}
