/// \file
/// Sections against CGAL's slicer (`Polygon_mesh_slicer`): as many polylines, of the same length
/// and area. Halves against CGAL's `clip`: of the same volume and area.
///
/// TREEFORM_STRESS_COUNT is the number of planes for each mesh (default 20).

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/real_solids.hpp>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using sliced_surface = CGAL::Surface_mesh<kernel::Point_3>;
using polyline = std::vector<kernel::Point_3>;

/// The mesh for CGAL; empty where it is no manifold.
sliced_surface sliced_surface_of(const tf::mesh& mesh) {
    sliced_surface made;
    for (const tf::point3& p : mesh.points) made.add_vertex({p.x, p.y, p.z});
    for (const tf::face& f : mesh.faces)
        if (made.add_face(sliced_surface::Vertex_index(f[0]), sliced_surface::Vertex_index(f[1]),
                          sliced_surface::Vertex_index(f[2])) == sliced_surface::null_face())
            return {};
    return made;
}

/// Number, length and area of what CGAL finds; the area is that of odd winding, so of a solid.
struct slice_totals {
    std::size_t count = 0;
    double length = 0.0;
    double area = 0.0;
};

kernel::Plane_3 plane_of_cgal(const tf::oriented_plane& plane) {
    return {kernel::Point_3(plane.at.x, plane.at.y, plane.at.z),
            kernel::Vector_3(plane.normal.x, plane.normal.y, plane.normal.z)};
}

/// Halves have the volume and area of CGAL's; \returns whether CGAL makes one.
bool check_half(const tf::mesh& solid, sliced_surface theirs, const tf::oriented_plane& plane) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    const tf::cut_result mine = tf::cut(solid, plane);
    REQUIRE(mine.certificate);
    try {
        if (!pmp::clip(theirs, plane_of_cgal(plane), CGAL::parameters::clip_volume(true)) ||
            !CGAL::is_closed(theirs))
            return false;
    } catch (const std::exception&) {  // of solids that meet themselves
        return false;
    }
    const double whole = tf::signed_volume(solid), area = tf::surface_area(solid);
    const double below = tf::signed_volume(mine.pieces[0].mesh);
    CHECK(std::abs(below - pmp::volume(theirs)) <= 1e-12 * whole + 1e-13 * area);
    CHECK(std::abs(tf::surface_area(mine.pieces[0].mesh) - pmp::area(theirs)) <= 1e-11 * area);
    CHECK(std::abs(below + tf::signed_volume(mine.pieces[1].mesh) - whole) <= 1e-12 * whole);
    return true;
}

slice_totals slices_of_cgal(const sliced_surface& mesh, const tf::oriented_plane& plane) {
    const CGAL::Polygon_mesh_slicer<sliced_surface, kernel> slicer(mesh);
    std::vector<polyline> lines;
    slicer(plane_of_cgal(plane), std::back_inserter(lines));
    const auto [x, y, normal] = plane.axes();
    const auto flat = [x = x, y = y](const kernel::Point_3& p) {
        return tf::point2{x.x * p.x() + x.y * p.y() + x.z * p.z(),
                          y.x * p.x() + y.y * p.y() + y.z * p.z()};
    };
    slice_totals made{lines.size()};
    std::vector<double> areas;
    for (const polyline& line : lines) {
        double twice = 0.0;
        const tf::point2 o = flat(line[0]);
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const tf::point2 p = flat(line[i]), q = flat(line[i + 1]);
            made.length += std::hypot(q.x - p.x, q.y - p.y);
            twice += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
        }
        areas.push_back(std::abs(twice) / 2);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const tf::point2 q = flat(lines[i][0]);
        bool hole = false;
        for (std::size_t j = 0; j < lines.size(); ++j)
            for (std::size_t k = 0; j != i && k + 1 < lines[j].size(); ++k) {
                const tf::point2 a = flat(lines[j][k]), b = flat(lines[j][k + 1]);
                if ((a.x <= q.x) != (b.x <= q.x) &&
                    a.y + (b.y - a.y) * (q.x - a.x) / (b.x - a.x) < q.y)
                    hole = !hole;
            }
        made.area += hole ? -areas[i] : areas[i];
    }
    return made;
}

/// \returns how many halves were compared
std::size_t check_sections(const tf::mesh& solid, std::uint64_t seed) {
    std::size_t halves = 0;
    const sliced_surface theirs = sliced_surface_of(solid);
    const auto box = tf::bounding_box(solid.points);
    REQUIRE(box.has_value());
    test::random source(seed);
    for (std::size_t i = 0; i < test::stress_count(20); ++i) {
        tf::oriented_plane plane;
        for (std::size_t k = 0; k < 3; ++k) {
            plane.at[k] = source.in(box->min[k], box->max[k]);
            plane.normal[k] = i % 4 == k ? 1.0 : i % 4 == 3 ? source.in(-1, 1) : 0.0;
        }
        CAPTURE(i);
        const tf::section_result mine = tf::section(solid, plane);
        CHECK(mine.layers[0].open_count == 0);
        for (const tf::section_loop& loop : mine.loops)
            CHECK((loop.area > 0.0) == (loop.depth % 2 == 0));
        if (theirs.number_of_faces() == 0) continue;
        const slice_totals expected = slices_of_cgal(theirs, plane);
        CHECK(mine.loops.size() == expected.count);
        CHECK(mine.layers[0].length == doctest::Approx(expected.length).epsilon(1e-12));
        CHECK(mine.layers[0].area == doctest::Approx(expected.area).epsilon(1e-12));
        if (i % 4 == seed % 4) halves += check_half(solid, theirs, plane) ? 1 : 0;
    }
    return halves;
}

}  // namespace

TEST_CASE("sections of solids are those of CGAL") {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh solid = test::ball(4, 2.0);
        for (int i = 0; i < 8; ++i) {
            const tf::mesh ball =
                test::moved(test::ball(2 + i % 2, source.in(0.3, 1.0)),
                            {source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)});
            solid = (i % 2 == 0 ? tf::difference(solid, ball) : tf::unite(solid, ball)).value();
        }
        CHECK(check_sections(solid, seed) > 2);
    }
}

TEST_CASE("sections of real solids are those of CGAL") {
    NEEDS_MODELS();
    std::size_t tried = 0, halves = 0;
    test::for_each_solid(4'000'000,
                         [&](const tf::mesh& mesh) { halves += check_sections(mesh, ++tried); });
    CHECK(tried > 20);
    CHECK(halves > 50);
    MESSAGE(halves << " halves of " << tried << " models");
}
