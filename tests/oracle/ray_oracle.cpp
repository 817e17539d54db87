/// \file
/// Rays and triangles, and points and closed meshes, against CGAL's exact kernel.
///
/// TREEFORM_STRESS_COUNT sets the pairs of each family (default 5,000).

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/soups.hpp>
#include <support/stress_families.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using cgal_surface = CGAL::Surface_mesh<exact_kernel::Point_3>;

exact_kernel::Point_3 point_in_exact(const tf::point3& p) { return {p.x, p.y, p.z}; }

long pairs_per_family() { return std::max(1L, static_cast<long>(test::stress_count(5000))); }

/// Wants no degenerate triangle.
bool meet_in_cgal(const tf::ray3& ray, const tf::triangle3& t) {
    const exact_kernel::Point_3 from(ray.origin[0], ray.origin[1], ray.origin[2]);
    const exact_kernel::Vector_3 along(ray.direction[0], ray.direction[1], ray.direction[2]);
    const exact_kernel::Triangle_3 triangle(point_in_exact(t[0]), point_in_exact(t[1]),
                                            point_in_exact(t[2]));
    if (ray.t_max > 1e300) return CGAL::do_intersect(exact_kernel::Ray_3(from, along), triangle);
    return CGAL::do_intersect(
        exact_kernel::Segment_3(from, from + along * exact_kernel::FT(ray.t_max)), triangle);
}

TEST_CASE("rays and segments meet the triangles that they meet in CGAL's exact kernel") {
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<tf::test::stress_family>(f);
        const std::string name(tf::test::name_of(family));
        CAPTURE(name);
        tf::test::stress_stream stream(family, 300 + f);
        test::random random(f);
        long met = 0, wrong = 0, skipped = 0;
        for (long i = 0; i < pairs_per_family(); ++i) {
            const auto [t, other] = stream.next();
            const tf::point3& o = other[0];
            // The other triangle's edges as rays, or rays from its corners to the first one's.
            const tf::point3& aim = i % 2 == 0 ? other[1] : t[random.below(3)];
            tf::ray3 ray{{o.x, o.y, o.z}, {aim.x - o.x, aim.y - o.y, aim.z - o.z}};
            if (i % 3 == 0) ray.t_max = 1.0;
            if (i % 7 == 0) ray.t_max = random.unit();
            const bool directed =
                ray.direction[0] != 0 || ray.direction[1] != 0 || ray.direction[2] != 0;
            if (!directed ||
                CGAL::collinear(point_in_exact(t[0]), point_in_exact(t[1]), point_in_exact(t[2])) ||
                ray.t_max == 0.0) {
                ++skipped;
                continue;
            }
            const bool expected = meet_in_cgal(ray, t);
            wrong += tf::intersect(ray, t).has_value() != expected;
            met += expected;
        }
        std::printf("%-18s %6ld met %5ld skipped %ld wrong\n", name.c_str(), met, skipped, wrong);
        CHECK(wrong == 0);
    }
}

cgal_surface exact_surface(const tf::mesh& mesh) {
    cgal_surface result;
    std::vector<cgal_surface::Vertex_index> ids;
    for (const tf::point3& p : mesh.points) ids.push_back(result.add_vertex(point_in_exact(p)));
    for (const tf::face& f : mesh.faces) result.add_face(ids[f[0]], ids[f[1]], ids[f[2]]);
    return result;
}

/// Compares some points: random ones, corners, and rounded points of faces and edges.
void check_points(const tf::mesh& mesh, std::uint64_t seed) {
    const cgal_surface in_cgal = exact_surface(mesh);
    REQUIRE(in_cgal.number_of_faces() == mesh.faces.size());
    const CGAL::Side_of_triangle_mesh<cgal_surface, exact_kernel> side(in_cgal);
    const auto tree = tf::build_face_tree(mesh);
    const tf::detail::intersect::point_locator locator(mesh, tree);
    tf::point3 low = mesh.points[0], high = low;
    for (const tf::point3& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    test::random random(seed);
    std::vector<tf::point3> points;
    for (int i = 0; i < 300; ++i) {
        points.push_back(
            {random.in(low.x, high.x), random.in(low.y, high.y), random.in(low.z, high.z)});
        const tf::face& f = mesh.faces[random.below(mesh.faces.size())];
        const tf::point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        if (i % 3 == 0) points.push_back(a);
        if (i % 3 == 1) points.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
        if (i % 3 == 2)
            points.push_back(
                {(a.x + b.x) / 4 + c.x / 2, (a.y + b.y) / 4 + c.y / 2, (a.z + b.z) / 4 + c.z / 2});
        points.push_back({a.x, b.y, random.in(low.z, high.z)});  // rays through many a corner
        points.push_back({random.in(low.x, high.x), a.y, a.z});
    }
    const auto found = locator.locate(points);
    std::array<int, 3> seen{};
    int wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto expected = side(point_in_exact(points[i]));
        const auto as_ours = expected == CGAL::ON_BOUNDED_SIDE ? tf::location::inside
                             : expected == CGAL::ON_BOUNDARY   ? tf::location::boundary
                                                               : tf::location::outside;
        wrong += found[i].where != as_ours;
        ++seen[static_cast<std::size_t>(as_ours)];
    }
    std::printf("%7zu faces: %d outside %d inside %d boundary %d wrong\n", mesh.faces.size(),
                seen[0], seen[1], seen[2], wrong);
    CHECK(wrong == 0);
}

TEST_CASE("points lie on the side of a closed model on which CGAL's exact kernel sees them") {
    NEEDS_MODELS();
    const std::filesystem::path all_models = test::models_folder();
    int models = 0;
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"clean", "cad"})  // closed ones that do not meet themselves
        for (const auto& entry : std::filesystem::recursive_directory_iterator(all_models / folder))
            if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& path : files) {
        const std::string kind = path.extension().string();
        if (kind != ".off" && kind != ".stl" && kind != ".obj" && kind != ".ply") continue;
        if (std::filesystem::file_size(path) > 4'000'000 || models == 12) continue;
        const tf::mesh mesh = tf::join_equal_points(tf::read(path.string()).mesh);
        if (mesh.faces.size() < 4 || tf::find_open_edge(mesh)) continue;
        const cgal_surface in_cgal = exact_surface(mesh);
        if (in_cgal.number_of_faces() != mesh.faces.size() || !CGAL::is_closed(in_cgal)) continue;
        CAPTURE(path.string());
        std::printf("%-28s", path.filename().string().c_str());
        check_points(mesh, 1);
        ++models;
    }
    CHECK(models > 0);
}

}  // namespace
