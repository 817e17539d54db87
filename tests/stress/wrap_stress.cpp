/// \file
/// Wraps of soups of all kinds, sizes and offsets, in doubles and floats: certified, around
/// everything, and nowhere nearer than they say.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

tf::mesh something(test::random& source) {
    switch (source.below(6)) {
        case 0:
            return test::random_soup(source, 1 + source.below(60), source.in(0.05, 1.0));
        case 1:
            return test::lattice_soup(source, 1 + source.below(80), 20, 1 + source.below(4));
        case 2:
            return test::fan(source, 2 + source.below(30));
        case 3:
            return test::moved(test::grid(5), {source.in(-1, 1), 7.0, source.in(-1, 1)});
        case 4:
            return test::together(test::lattice_box(source), test::lattice_box(source));
        default:
            return test::turned(test::ball(2, source.in(0.5, 2.0)), {1, 2, 3}, source.in(0, 3));
    }
}

void check_wrap(const tf::mesh& mesh, double size, const tf::offset_options& options) {
    const tf::offset_result made = tf::wrap(mesh, size, options);
    CHECK(made.certificate);
    CHECK(test::is_clean_solid(made.mesh));
    CHECK(tf::mesh_intersections(made.mesh, mesh, {.first_only = true}).pairs.empty());
    for (const tf::face& f : mesh.faces) CHECK(tf::contains(made.mesh, mesh.points[f[0]]));
    const tf::prepared_mesh inner = tf::prepared_mesh::borrow(mesh);
    double most = 0.0;
    double least = 2.0 * made.distance;
    for (const auto& near : tf::closest_point(inner, made.mesh.points)) {
        most = std::max(most, near->distance);
        least = std::min(least, near->distance);
    }
    CHECK(most < 1.02 * made.distance);
    CHECK(least > 0.98 * made.distance);
}

}  // namespace

TEST_CASE("soups, fans, grids, boxes and balls") {
    test::random source(test::stress_seed());
    for (std::uint64_t n = 0; n < test::stress_count(120); ++n) {
        CAPTURE(n);
        const tf::mesh mesh = something(source);
        const tf::box3 box = tf::bounding_box(mesh.points).value();
        const double size = std::exp2(source.in(-5.0, 1.0)) * std::max(box.diagonal(), 0.1);
        tf::offset_options options;
        if (source.below(2) == 0) options.offset = std::exp2(source.in(-6.0, 1.0)) * size;
        if (source.below(2) == 0) options.precision = tf::precision::float32;
        check_wrap(mesh, size, options);
    }
}
