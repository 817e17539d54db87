/// \file
/// Real solids cut by planes, also through their vertices and in their faces: every piece is
/// certified, and they add up; sections in vertices are closed.
///
/// TREEFORM_STRESS_COUNT is the number of planes for each model (default 6).

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/real_solids.hpp>
#include <support/settings.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

/// Through a vertex: across an axis, along the normal of one of its faces, or anyhow.
tf::oriented_plane plane_in(const tf::mesh& mesh, test::random& source) {
    const tf::face& f = mesh.faces[source.below(mesh.faces.size())];
    const tf::point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    tf::oriented_plane plane{a, {}};
    const std::size_t kind = source.below(5);
    if (kind < 3)
        plane.normal[kind] = source.below(2) == 0 ? 1.0 : -1.0;
    else if (kind == 3)
        plane.normal = {(b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y),
                        (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z),
                        (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)};
    else
        plane.normal = {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
    return plane;
}

}  // namespace

TEST_CASE("real solids fall apart into certified pieces that add up") {
    NEEDS_MODELS();
    std::uint64_t cuts = 0, models = 0;
    test::for_each_solid(2'000'000, [&](const tf::mesh& mesh) {
        test::random source(++models);
        const double volume = tf::signed_volume(mesh), area = tf::surface_area(mesh);
        const tf::prepared_mesh prepared = tf::prepared_mesh::borrow(mesh);
        for (std::size_t i = 0; i < test::stress_count(6); ++i) {
            CAPTURE(i);
            const tf::oriented_plane plane = plane_in(mesh, source);
            if (plane.normal == tf::point3{}) continue;
            const tf::precision precision =
                i % 2 == 0 ? tf::precision::float64 : tf::precision::float32;
            const tf::cut_result made = tf::cut(prepared, plane, {.precision = precision});
            CHECK_MESSAGE(made.certificate, made.certificate.message());
            double sum = 0.0;
            for (const tf::cut_piece& piece : made.pieces) sum += tf::signed_volume(piece.mesh);
            CHECK(std::abs(sum - volume) <=
                  1e-12 * std::abs(volume) + 4 * area * made.certificate.max_displacement);
            const tf::section_result section = tf::section(prepared, plane);
            CHECK(section.layers[0].open_count == 0);
            CHECK(section.layers[0].area >= -1e-12 * area);
            ++cuts;
        }
    });
    CHECK(models > 20);
    MESSAGE(cuts << " cuts of " << models << " models");
}
