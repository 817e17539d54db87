/// \file
/// Real models grown, shrunk, hollowed and made thick, judged by CGAL: closed, oriented outward, no
/// two faces meet; distances of points of the result, and sides of points of space, by trying all
/// faces of the input.
///
/// TREEFORM_STRESS_COUNT is the number of points of each kind for each result (default 8).

#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
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
#include <limits>
#include <vector>

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;

kernel::Point_3 of_cgal(const tf::point3& p) { return {p.x, p.y, p.z}; }

void check_by_cgal(const tf::mesh& mesh) {
    std::vector<kernel::Point_3> points;
    for (const tf::point3& p : mesh.points) points.push_back(of_cgal(p));
    std::vector<std::array<std::size_t, 3>> faces;
    for (const tf::face& f : mesh.faces) faces.push_back({f[0], f[1], f[2]});
    REQUIRE(processing::is_polygon_soup_a_polygon_mesh(faces));
    surface made;
    processing::polygon_soup_to_polygon_mesh(points, faces, made);
    CHECK(CGAL::is_closed(made));
    CHECK(processing::does_bound_a_volume(made));
    CHECK_FALSE(processing::does_self_intersect(made));
}

/// By trying all faces; those without area are their edges.
double distance_to(const tf::mesh& mesh, const tf::point3& p) {
    const kernel::Point_3 q = of_cgal(p);
    double least = std::numeric_limits<double>::infinity();
    for (const tf::face& f : mesh.faces) {
        const std::array t{of_cgal(mesh.points[f[0]]), of_cgal(mesh.points[f[1]]),
                           of_cgal(mesh.points[f[2]])};
        if (!CGAL::collinear(t[0], t[1], t[2])) {
            least =
                std::min(least, CGAL::squared_distance(q, kernel::Triangle_3(t[0], t[1], t[2])));
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k)
            least = std::min(
                least, t[k] == t[(k + 1) % 3]
                           ? CGAL::squared_distance(q, t[k])
                           : CGAL::squared_distance(q, kernel::Segment_3(t[k], t[(k + 1) % 3])));
    }
    return std::sqrt(least);
}

tf::point3 on_face(const tf::mesh& mesh, test::random& source) {
    const tf::face& f = mesh.faces[source.below(mesh.faces.size())];
    double u = source.in(0, 1), v = source.in(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    tf::point3 p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = (1 - u - v) * mesh.points[f[0]][k] + u * mesh.points[f[1]][k] +
               v * mesh.points[f[2]][k];
    return p;
}

/// `inside(p, d)`: whether a point of space at distance d of `of` is to be in the result.
template <class Inside>
void check(const tf::offset_result& made, const tf::mesh& of, bool outer_stays,
           const Inside& inside) {
    if (made.certificate.status == tf::status::vanished) return;
    REQUIRE_MESSAGE(made.certificate, made.certificate.message());
    check_by_cgal(made.mesh);
    CHECK(made.least_distance >= made.distance - 2 * made.resolution);
    CHECK(made.greatest_distance <= made.distance + 2 * made.resolution);
    test::random source(test::stress_seed());
    const auto box = *tf::bounding_box(made.mesh.points);
    const double tiny = 1e-12 * box.diagonal();
    const tf::prepared_mesh result = tf::prepared_mesh::borrow(made.mesh);
    for (std::size_t i = 0; i < test::stress_count(8); ++i) {
        const double d = distance_to(of, on_face(made.mesh, source));
        CAPTURE(d);
        const bool outer = outer_stays && d <= tiny;
        CHECK((outer || (d >= made.least_distance - tiny && d <= made.greatest_distance + tiny)));
        tf::point3 p = on_face(of, source);
        for (std::size_t k = 0; k < 3; ++k) p[k] += source.in(-2, 2) * made.distance;
        const double away = distance_to(of, p);
        if (std::abs(away - made.distance) > 2 * made.resolution + tiny)
            CHECK(tf::contains(result, p) == inside(p, away));
    }
}

/// Of the box around the faces.
double diagonal_of(const tf::mesh& mesh) {
    std::vector<tf::point3> used;
    for (const tf::face& f : mesh.faces)
        for (const std::uint32_t v : f) used.push_back(mesh.points[v]);
    return tf::bounding_box(used)->diagonal();
}

}  // namespace

TEST_CASE("any real mesh is made thick") {
    NEEDS_MODELS();
    std::uint64_t models = 0;
    test::for_each_model(1'000'000, [&](const tf::mesh& mesh) {
        const double half = diagonal_of(mesh) / 20;
        if (!(half > 0.0) || half >= 0x1p140) return;  // beyond 2^150 it is refused
        const auto made = tf::thicken(mesh, 2 * half, {.resolution = half / 2});
        check(made, mesh, false, [&](const tf::point3&, double away) { return away < half; });
        ++models;
    });
    CHECK(models > 40);
    MESSAGE(models << " models made thick");
}

TEST_CASE("real solids grow, shrink and are hollowed") {
    NEEDS_MODELS();
    std::uint64_t models = 0;
    test::for_each_solid(500'000, [&](const tf::mesh& mesh) {
        const tf::prepared_mesh solid = tf::prepared_mesh::borrow(mesh);
        const double d = diagonal_of(mesh) / 20;
        const tf::offset_options how{.resolution = d / 2};
        const auto within = [&](const tf::point3& p) { return tf::contains(solid, p); };
        check(tf::offset(solid, d, how), mesh, false,
              [&](const tf::point3& p, double away) { return within(p) || away < d; });
        check(tf::offset(solid, -d, how), mesh, false,
              [&](const tf::point3& p, double away) { return within(p) && away > d; });
        check(tf::hollow(solid, d, how), mesh, true,
              [&](const tf::point3& p, double away) { return within(p) && away < d; });
        ++models;
    });
    CHECK(models > 10);
    MESSAGE(models << " solids");
}
