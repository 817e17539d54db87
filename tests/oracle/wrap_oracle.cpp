/// \file
/// Wraps against CGAL's (`alpha_wrap_3`): both are of the same size and offset, and so enclose
/// about as much. What CGAL finds in ours: nothing that meets, nothing open.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;

struct soup {
    std::vector<kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> faces;
};

soup of_cgal(const tf::mesh& mesh) {
    soup result;
    for (const tf::point3& p : mesh.points) result.points.emplace_back(p.x, p.y, p.z);
    for (const tf::face& f : mesh.faces) result.faces.push_back({f[0], f[1], f[2]});
    return result;
}

double volume_of_cgal(const tf::mesh& mesh, double size, double offset) {
    const soup given = of_cgal(mesh);
    surface wrap;
    CGAL::alpha_wrap_3(given.points, given.faces, size, offset, wrap);
    return CGAL::to_double(processing::volume(wrap));
}

void check(const tf::mesh& mesh, double size, double offset, double tolerance) {
    CAPTURE(size);
    const tf::mesh mine = tf::wrap(mesh, size, {.offset = offset}).value();
    const soup faces = of_cgal(mine);
    REQUIRE(processing::is_polygon_soup_a_polygon_mesh(faces.faces));
    surface made;
    processing::polygon_soup_to_polygon_mesh(faces.points, faces.faces, made);
    CHECK(CGAL::is_closed(made));
    CHECK_FALSE(processing::does_self_intersect(made));
    const double expected = volume_of_cgal(mesh, size, offset);
    CHECK(tf::signed_volume(mine) == doctest::Approx(expected).epsilon(tolerance));
}

/// Without the two faces of one side.
tf::mesh open_box() {
    tf::mesh mesh = test::box(1, 1, 1);
    mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 2);
    return mesh;
}

}  // namespace

TEST_CASE("solids") {
    for (const double size : {0.4, 0.2, 0.1}) {
        check(test::ball(3, 1.0), size, size / 30, 0.01);
        check(test::box(1, 2, 3), size, size / 30, 0.01);
        const tf::mesh box = test::box(1, 1, 1);
        check(test::together(box, test::moved(box, {0.5, 0.25, 1.1})), size, size / 30, 0.01);
    }
}

TEST_CASE("surfaces with a hole, wider than the size and narrower") {
    check(open_box(), 1.5, 0.05, 0.03);
    check(open_box(), 0.2, 0.02, 0.03);
    check(open_box(), 0.05, 0.01, 0.03);
}

TEST_CASE("soups") {
    test::random source(5);
    for (const double size : {0.3, 0.1}) {
        check(test::random_soup(source, 30, 0.5), size, size / 10, 0.03);
        check(test::lattice_soup(source, 50, 20, 3), size, size / 10, 0.03);
    }
}
