/// \file
/// Clashes of the parts of a kitchen and of a robot's arm in 100 poses against CGAL: all pairs, by
/// its trees of triangles, and its test of points inside closed meshes.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>
#include <support/franka.hpp>
#include <support/models.hpp>
#include <support/random.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using point = kernel::Point_3;
using triangle = kernel::Triangle_3;
using triangles = std::vector<triangle>;
using primitive = CGAL::AABB_triangle_primitive<kernel, triangles::const_iterator>;
using triangle_tree = CGAL::AABB_tree<CGAL::AABB_traits<kernel, primitive>>;
using surface = CGAL::Surface_mesh<point>;

point in_cgal(const tf::point3& p) { return {p.x, p.y, p.z}; }

/// A part as CGAL sees it. Without its degenerate faces, for which its tests are not meant.
struct cgal_part {
    triangles faces{};
    std::unique_ptr<triangle_tree> tree{};
    surface closed{};  ///< empty where the part bounds no solid that CGAL can ask
    std::unique_ptr<CGAL::Side_of_triangle_mesh<surface, kernel>> side{};
    std::vector<point> corners{};  ///< one of each component

    explicit cgal_part(tf::mesh_view mesh) {
        for (const tf::face& f : mesh.faces)
            faces.emplace_back(in_cgal(mesh.points[f[0]]), in_cgal(mesh.points[f[1]]),
                               in_cgal(mesh.points[f[2]]));
        tree = std::make_unique<triangle_tree>(faces.begin(), faces.end());
        const auto component = tf::face_components(mesh.points.size(), mesh.faces);
        for (std::size_t f = 0; f < faces.size(); ++f)
            if (component[f] == corners.size()) corners.push_back(faces[f].vertex(0));
        if (tf::find_open_edge(mesh)) return;
        std::vector<point> points;
        for (const tf::point3& p : mesh.points) points.push_back(in_cgal(p));
        std::vector<std::vector<std::size_t>> polygons;
        for (const tf::face& f : mesh.faces) polygons.push_back({f[0], f[1], f[2]});
        namespace pmp = CGAL::Polygon_mesh_processing;
        if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) return;
        pmp::polygon_soup_to_polygon_mesh(points, polygons, closed);
        if (!CGAL::is_closed(closed)) return;
        side = std::make_unique<CGAL::Side_of_triangle_mesh<surface, kernel>>(closed);
    }
    cgal_part(cgal_part&&) = delete;

    [[nodiscard]] bool meets(const cgal_part& other) const {
        if (!CGAL::do_overlap(tree->bbox(), other.tree->bbox())) return false;
        for (const triangle& t : other.faces)
            if (tree->do_intersect(t)) return true;
        return false;
    }
    [[nodiscard]] bool holds_part_of(const cgal_part& other) const {
        if (!side) return false;
        for (const point& p : other.corners)
            if ((*side)(p) == CGAL::ON_BOUNDED_SIDE) return true;
        return false;
    }
};

tf::mesh without_degenerate(const tf::mesh& mesh) {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const tf::face& c = mesh.faces[f];
        if (!tf::collinear(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]))
            kept.push_back(f);
    }
    return tf::join_equal_points(tf::submesh(mesh, kept).mesh);
}

struct tally {
    std::size_t pairs = 0, meeting = 0, inside = 0, not_asked = 0;
};

/// One pair: whether it clashes or touches is what CGAL says.
void compare(const cgal_part& a, const cgal_part& b, std::optional<tf::mesh_relation> how,
             tally& sum) {
    ++sum.pairs;
    const bool meet = a.meets(b);
    sum.meeting += meet ? 1 : 0;
    if (meet) {
        REQUIRE(how.has_value());
        return;
    }
    if (a.holds_part_of(b) || b.holds_part_of(a)) {
        REQUIRE(how == tf::mesh_relation::penetrating);
        ++sum.inside;
    } else if (how) {  // only a solid that CGAL cannot ask may hold a part
        REQUIRE(how == tf::mesh_relation::penetrating);
        REQUIRE((!a.side || !b.side));
        ++sum.not_asked;
    }
}

}  // namespace

TEST_CASE("clash: of all pairs of a kitchen's parts, those meet that do by CGAL") {
    NEEDS_MODELS();
    tf::body_set set;
    set.add_named_parts(tf::read(test::models_folder() / "scene/kitchen.obj"));
    REQUIRE(set.shapes.size() == 160);
    std::vector<tf::prepared_mesh> parts;
    std::vector<std::unique_ptr<cgal_part>> theirs;
    for (const tf::prepared_mesh& one : set.shapes) {
        const tf::mesh_view view = one.indexed_view();
        parts.emplace_back(without_degenerate(
            {{view.points.begin(), view.points.end()}, {view.faces.begin(), view.faces.end()}}));
        theirs.push_back(std::make_unique<cgal_part>(parts.back().indexed_view()));
    }
    tf::clash_options options;
    options.volumes = options.depths = false;
    const auto found = tf::clash(parts, options);
    tally sum;
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (std::uint32_t j = i + 1; j < parts.size(); ++j) {
            CAPTURE(i);
            CAPTURE(j);
            std::optional<tf::mesh_relation> how;
            if (next < found.pairs.size() && found.pairs[next].a == i && found.pairs[next].b == j)
                how = found.pairs[next++].relation;
            compare(*theirs[i], *theirs[j], how, sum);
        }
    CHECK(next == found.pairs.size());
    CHECK(sum.pairs == 12720);
    MESSAGE(sum.pairs << " pairs, " << sum.meeting << " meet, " << sum.inside << " inside, "
                      << sum.not_asked << " in solids that CGAL cannot ask");
}

TEST_CASE("check_poses: of a Franka arm in 100 poses, those links meet that do by CGAL") {
    NEEDS_MODELS();
    const auto folder = test::models_folder() / "robot";
    const auto path = std::filesystem::temp_directory_path() / "treeform_franka.urdf";
    test::write_franka(path, folder);
    const tf::urdf_robot robot = tf::read_urdf(path);
    std::filesystem::remove(path);
    REQUIRE(robot.meshes.size() == 9);
    std::vector<tf::prepared_mesh> parts;
    for (const tf::urdf_mesh& one : robot.meshes)
        parts.emplace_back(without_degenerate(tf::read(one.file).mesh));
    test::random source(7);
    std::vector<tf::transform<3>> poses;
    for (int p = 0; p < 100; ++p) {
        std::map<std::string, double> values;
        for (std::size_t i = 0; i < 7; ++i)
            values["joint" + std::to_string(i + 1)] =
                source.in(test::franka_limits[i][0], test::franka_limits[i][1]);
        const auto at = robot.link_transforms(values);
        for (const tf::urdf_mesh& one : robot.meshes) poses.push_back(at[one.link]);
    }
    const auto found = tf::check_poses(parts, poses);
    tally sum;
    for (std::size_t p = 0; p < found.poses.size(); ++p) {
        CAPTURE(p);
        std::vector<std::unique_ptr<cgal_part>> theirs;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto [points, faces] = parts[i].indexed_view();
            tf::mesh there{{points.begin(), points.end()}, {faces.begin(), faces.end()}};
            for (tf::point3& q : there.points) q = poses[p * parts.size() + i](q);
            theirs.push_back(std::make_unique<cgal_part>(there));
        }
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < parts.size(); ++i)
            for (std::uint32_t j = i + 1; j < parts.size(); ++j) {
                CAPTURE(i);
                CAPTURE(j);
                std::optional<tf::mesh_relation> how;
                const auto& all = found.poses[p];
                if (next < all.size() && all[next].a == i && all[next].b == j)
                    how = all[next++].relation;
                compare(*theirs[i], *theirs[j], how, sum);
            }
        CHECK(next == found.poses[p].size());
    }
    CHECK(sum.meeting > 100);
    MESSAGE(sum.pairs << " pairs, " << sum.meeting << " meet, " << sum.inside << " inside, "
                      << sum.not_asked << " in solids that CGAL cannot ask");
}
