/// \file
/// Volumes of set operations beside those of CGAL's corefinement, wherever that gives an answer:
/// clean solids among the models, each with a turned copy of itself and with another one. Without
/// TREEFORM_MODELS_DIR nothing is checked.
///
/// TREEFORM_STRESS_COUNT sets the faces of the largest file (default 3000).

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/rational_volume.hpp>
#include <support/settings.hpp>
#include <support/solid_checks.hpp>
#include <support/truth.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;

std::size_t most_faces() { return test::setting("TREEFORM_STRESS_COUNT", 3000); }

/// Its longest side 1, about the origin.
tf::mesh to_unit_size(tf::mesh mesh) {
    const tf::box3 box = tf::bounding_box(mesh.points).value();
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, box.max[k] - box.min[k]);
    for (tf::point3& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - (box.min[k] + box.max[k]) / 2) / size;
    return mesh;
}

/// About an axis across all three, by about 50 degrees, and moved a little.
tf::mesh turned(tf::mesh mesh) {
    for (tf::point3& p : mesh.points) {
        const auto [x, y, z] = p;
        p = {(14 * x - 5 * y + 2 * z) / 15 + 0.11, (2 * x + 10 * y + 11 * z) / 15 - 0.07,
             (-5 * x - 10 * y + 10 * z) / 15 + 0.05};
    }
    return mesh;
}

/// Empty where it is no manifold.
surface to_surface(const tf::mesh& mesh) {
    std::vector<kernel::Point_3> points;
    for (const tf::point3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const tf::face& f : mesh.faces) polygons.push_back({f[0], f[1], f[2]});
    surface made;
    if (PMP::is_polygon_soup_a_polygon_mesh(polygons))
        PMP::polygon_soup_to_polygon_mesh(points, polygons, made);
    PMP::remove_isolated_vertices(made);
    made.collect_garbage();
    return made;
}

mpq_class volume_of(const surface& of) {
    tf::mesh mesh;
    for (const auto v : of.vertices()) {
        const auto& p = of.point(v);
        mesh.points.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : of.faces()) {
        tf::face& corners = mesh.faces.emplace_back();
        std::size_t k = 0;
        for (const auto v : CGAL::vertices_around_face(of.halfedge(f), of))
            corners[k++] = static_cast<std::uint32_t>(v);
    }
    return test::volume_of(mesh);
}

/// Nothing where corefinement gives up: its answer is no manifold, or it throws.
std::optional<mpq_class> corefined(const tf::mesh& a, const tf::mesh& b, const std::string& what) {
    surface x = to_surface(a), y = to_surface(b), made;
    bool done = false;
    try {
        if (what == "a+b") done = PMP::corefine_and_compute_union(x, y, made);
        if (what == "a*b") done = PMP::corefine_and_compute_intersection(x, y, made);
        if (what == "a-b") done = PMP::corefine_and_compute_difference(x, y, made);
    } catch (const std::exception&) {
        return std::nullopt;
    }
    if (!done) return std::nullopt;
    return volume_of(made);
}

struct named_solid {
    std::string file;
    tf::mesh mesh;
};

/// What bounds a volume as CGAL wants it, too.
std::vector<named_solid> solids(const std::filesystem::path& folder) {
    std::set<std::string> files;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH.csv"))
        files.insert(row.text("file"));
    std::vector<named_solid> found;
    for (const std::string& file : files) {
        tf::mesh mesh;
        try {
            mesh = tf::join_equal_points(tf::read(folder / file).mesh);
        } catch (const tf::io_error&) {
            continue;  // files that no reader should take
        }
        if (mesh.faces.empty() || mesh.faces.size() > most_faces()) continue;
        if (!test::is_clean_solid(mesh)) continue;
        mesh = to_unit_size(std::move(mesh));
        if (!test::is_clean_solid(mesh) || test::volume_of(mesh) <= 0) continue;
        const surface as_given = to_surface(mesh);
        if (as_given.number_of_faces() != mesh.faces.size() || !CGAL::is_closed(as_given) ||
            !PMP::does_bound_a_volume(as_given))
            continue;
        found.push_back({file, std::move(mesh)});
    }
    return found;
}

}  // namespace

TEST_CASE("corefinement: where CGAL has an answer, volumes agree to 1e-12") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    const std::vector<named_solid> found = solids(folder);
    std::size_t compared = 0, without = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const std::size_t j : {i, (i + 1) % found.size()}) {
            const tf::mesh& a = found[i].mesh;
            const tf::mesh b = turned(found[j].mesh);
            const std::vector<tf::mesh_view> views{a, b};
            for (const char* what : {"a+b", "a*b", "a-b"}) {
                CAPTURE(found[i].file);
                CAPTURE(found[j].file);
                CAPTURE(what);
                const std::optional<mpq_class> expected = corefined(a, b, what);
                if (!expected) {
                    ++without;
                    continue;
                }
                const tf::boolean_result made = tf::boolean(views, {what, 2});
                CHECK(made.certificate);
                const mpq_class off = abs(test::volume_of(made.mesh) - *expected);
                CHECK(off <= mpq_class(1e-12) * abs(*expected));
                if (*expected != 0)
                    largest = std::max(largest, mpq_class(off / abs(*expected)).get_d());
                ++compared;
            }
        }
    CHECK(compared > without);
    MESSAGE(found.size() << " solids, " << compared << " volumes compared, largest difference "
                         << largest << "; corefinement gave none " << without << " times");
}
