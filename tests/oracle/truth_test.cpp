/// \file
/// Real files against what an exact kernel found in them: every count of TRUTH.csv that concerns
/// points, topology and self-intersections. Without TREEFORM_MODELS_DIR nothing is checked.

#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/invariances.hpp>
#include <support/models.hpp>
#include <support/truth.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using counts = std::map<std::string, std::int64_t>;

void round_to_float(tf::mesh& mesh) {
    using tf::detail::base::nearest_float;
    for (tf::point3& p : mesh.points)
        p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

/// The finite points, and the faces that use no other.
tf::mesh finite_part(const tf::mesh& mesh, const tf::invalid_faces& defects) {
    constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();
    tf::mesh part;
    std::vector<std::uint32_t> new_of_old(mesh.points.size(), 0);
    for (const std::uint32_t i : defects.nonfinite_points) new_of_old[i] = dropped;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (new_of_old[i] == dropped) continue;
        new_of_old[i] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(mesh.points[i]);
    }
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        if (std::binary_search(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(), i))
            continue;
        const tf::face& f = mesh.faces[i];
        part.faces.push_back({new_of_old[f[0]], new_of_old[f[1]], new_of_old[f[2]]});
    }
    return part;
}

std::int64_t of(std::uint64_t n) { return static_cast<std::int64_t>(n); }

void add_topology(const tf::mesh& mesh, counts& found) {
    const tf::topology_counts c = tf::count_topology(mesh.points.size(), mesh.faces);
    found["points_referenced"] = of(c.points_used);
    found["repeated_corner_triangles"] = of(c.repeated_corner_faces);
    found["duplicate_triangles"] = of(c.duplicate_faces);
    found["boundary_edges"] = of(c.boundary_edges);
    found["nonmanifold_edges"] = of(c.nonmanifold_edges);
    found["misoriented_edges"] = of(c.misoriented_edges);
    found["nonmanifold_points"] = of(c.nonmanifold_points);
    found["components_vertex"] = of(c.components_by_point);
    found["components_edge"] = of(c.components_by_edge);
    found["euler"] = of(c.points_used) - of(c.edges) + of(c.faces);
    found["closed"] = c.closed_manifold ? 1 : 0;
}

tf::triangle3 corners(const tf::mesh& mesh, std::uint32_t face) {
    const tf::face& f = mesh.faces[face];
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

std::size_t shared_corners(tf::face a, tf::face b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    tf::face shared{};
    const auto end = std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), shared.begin());
    return static_cast<std::size_t>(end - shared.begin());
}

void add_pairs(const tf::mesh& mesh, counts& found) {
    std::array<std::int64_t, 4> share{};
    std::int64_t coplanar = 0;
    std::set<std::uint32_t> faces;
    for (const tf::face_pair& pair :
         tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).pairs) {
        if (pair.kind == tf::pair_kind::degenerate) continue;
        ++share[shared_corners(mesh.faces[pair.a], mesh.faces[pair.b])];
        coplanar += tf::intersect(corners(mesh, pair.a), corners(mesh, pair.b)).coplanar ? 1 : 0;
        faces.insert({pair.a, pair.b});
    }
    for (std::size_t i = 0; i < share.size(); ++i)
        found["si_pairs_share" + std::to_string(i)] = share[i];
    found["si_pairs"] = share[0] + share[1] + share[2] + share[3];
    found["si_pairs_coplanar"] = coplanar;
    found["si_triangles"] = of(faces.size());
}

counts measure(tf::mesh mesh, bool as_float) {
    counts found;
    if (as_float) round_to_float(mesh);
    found["vertices_stored"] = of(mesh.points.size());
    found["triangles"] = of(mesh.faces.size());
    const tf::invalid_faces stored = tf::find_invalid_faces(mesh);
    REQUIRE(stored.out_of_range_faces.empty());
    found["nonfinite_vertices"] = of(stored.nonfinite_points.size());
    found["nonfinite_triangles"] = of(stored.nonfinite_faces.size());
    const tf::mesh joined = tf::join_equal_points(finite_part(mesh, stored));
    const tf::invalid_faces defects = tf::find_invalid_faces(joined);
    CHECK(defects.nonfinite_points.empty());
    CHECK(defects.degenerate_faces.size() == stored.degenerate_faces.size());
    found["points_unique"] = of(joined.points.size());
    found["degenerate_triangles"] = of(defects.degenerate_faces.size());
    add_topology(joined, found);
    add_pairs(joined, found);
    return found;
}

}  // namespace

TEST_CASE("truth: every count of every file is that of the exact kernel") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    int rows = 0;
    int meshes = 0;
    int figures = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH.csv")) {
        if (row.text("status") != "ok") continue;
        CAPTURE(row.text("file"));
        CAPTURE(row.text("precision"));
        const tf::mesh_file file = tf::read(folder / row.text("file"));
        const counts found = measure(file.mesh, row.text("precision") == "f32");
        for (const auto& [name, count] : found) {
            const auto& column = name;  // Clang 14 captures no structured binding
            CAPTURE(column);
            if (column == "closed")
                CHECK(row.text(column) == (count == 1 ? "yes" : "no"));
            else
                CHECK(row.number(column) == count);
            ++figures;
        }
        ++rows;
        if (!file.mesh.faces.empty()) ++meshes;
    }
    CHECK(rows > 0);
    MESSAGE(rows << " rows checked, " << meshes << " of them meshes, " << figures << " figures");
}

TEST_CASE("truth: order, axes, scale and threads change no pair of a model") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    constexpr std::size_t most_faces = 4000;  // keeps this test to seconds
    constexpr std::uint64_t most_box_pairs = 60000;
    int models = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH.csv")) {
        if (row.text("status") != "ok" || row.text("precision") == "f32") continue;
        CAPTURE(row.text("file"));
        const tf::mesh stored = tf::read(folder / row.text("file")).mesh;
        if (stored.faces.empty() || stored.faces.size() > most_faces) continue;
        const tf::mesh mesh =
            tf::join_equal_points(finite_part(stored, tf::find_invalid_faces(stored)));
        if (tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).box_pairs >
            most_box_pairs)
            continue;
        test::random source(stored.faces.size());
        CHECK(test::changes_that_matter(source, mesh) == std::vector<std::string>{});
        ++models;
    }
    CHECK(models > 0);
    MESSAGE(models << " models checked");
}
