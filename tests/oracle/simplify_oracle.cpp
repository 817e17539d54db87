/// \file
/// Real models and stressed ones with fewer faces, looked at by CGAL: solids still bound one, no
/// faces meet, and no sample of either surface is further from the other than was said.
///
/// TREEFORM_STRESS_COUNT is the number of hilly surfaces (default 6).

#include <treeform/mesh/simplify.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/real_solids.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using simplified_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using simplified_surface = CGAL::Surface_mesh<simplified_kernel::Point_3>;

simplified_surface surface_of(const tf::mesh& mesh) {
    const tf::mesh joined = tf::join_equal_points(mesh);
    std::vector<simplified_kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> faces;
    for (const tf::point3& p : joined.points) points.emplace_back(p.x, p.y, p.z);
    for (const tf::face& f : joined.faces) faces.push_back({f[0], f[1], f[2]});
    REQUIRE(processing::is_polygon_soup_a_polygon_mesh(faces));
    simplified_surface made;
    processing::polygon_soup_to_polygon_mesh(points, faces, made);
    processing::remove_isolated_vertices(made);
    return made;
}

double furthest(const simplified_surface& from, const simplified_surface& to) {
    return processing::approximate_Hausdorff_distance<CGAL::Sequential_tag>(
        from, to, CGAL::parameters::number_of_points_on_faces(20'000));
}

double simplified_diagonal(const tf::mesh& mesh) {
    treeform::aabb<double, 3> box;
    for (const tf::point3& p : mesh.points) box.include(p);
    return std::hypot(box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]);
}

void check_simplified(const tf::mesh& mesh, double distance, tf::precision precision) {
    CAPTURE(distance);
    const tf::simplify_result made = tf::simplify(mesh, distance, {.precision = precision});
    CHECK_MESSAGE(made.certificate, made.certificate.message());
    CHECK(made.mesh.faces.size() <= mesh.faces.size());
    CHECK(made.input_to_result_bound <= distance);
    CHECK(made.result_to_input_bound <= distance);
    const simplified_surface before = surface_of(mesh), after = surface_of(made.mesh);
    CHECK(CGAL::is_closed(after) == CGAL::is_closed(before));
    CHECK_FALSE(processing::does_self_intersect(after));
    // What CGAL computes is rounded, too.
    const double rounding = 1e-12 * simplified_diagonal(mesh);
    CHECK(furthest(before, after) <= made.input_to_result_bound + rounding);
    CHECK(furthest(after, before) <= made.result_to_input_bound + rounding);
}

}  // namespace

TEST_CASE("simplified solids are solids to CGAL, and as near as was said") {
    NEEDS_MODELS();
    std::uint64_t models = 0;
    test::for_each_solid(1'100'000, [&](const tf::mesh& mesh) {
        if (mesh.faces.size() > 30'000) return;
        const double diagonal = simplified_diagonal(mesh);
        check_simplified(mesh, (models % 2 == 0 ? 1e-3 : 1e-2) * diagonal,
                         models % 3 == 0 ? tf::precision::float32 : tf::precision::float64);
        ++models;
    });
    CHECK(models > 15);
    MESSAGE(models << " models");
}

TEST_CASE("simplified hills are as near as was said, and do not meet") {
    for (std::size_t i = 0; i < test::stress_count(6); ++i) {
        CAPTURE(i);
        test::random source(i);
        const std::uint32_t n = 40;
        const double high = std::pow(10.0, source.in(-6, 0)), wave = source.in(1, 20);
        const double noise = high * source.in(0, 0.2), far = i % 2 == 0 ? 0.0 : 1e6;
        tf::mesh hills;
        for (std::uint32_t x = 0; x <= n; ++x)
            for (std::uint32_t y = 0; y <= n; ++y)
                hills.points.push_back(
                    {far + x, y + 0.0,
                     n * (high * std::sin(wave * x / n) * std::cos(wave * y / n) +
                          noise * source.in(0, 1))});
        for (std::uint32_t x = 0; x < n; ++x)
            for (std::uint32_t y = 0; y < n; ++y) {
                const std::uint32_t p = x * (n + 1) + y, q = p + n + 1;
                hills.faces.push_back({p, q, q + 1});
                hills.faces.push_back({p, q + 1, p + 1});
            }
        check_simplified(hills, n * high * source.in(0.01, 0.3), tf::precision::float64);
    }
}
