#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::together;

tf::boolean_result result_of(const std::vector<tf::mesh>& meshes, const std::string& text,
                             tf::boolean_options options = {}) {
    return tf::boolean(std::vector<tf::mesh_view>(meshes.begin(), meshes.end()),
                       {text, meshes.size()}, options);
}

/// After a look at whether it is the same solid as without being simplified.
tf::mesh simplified(const std::vector<tf::mesh>& meshes, const std::string& text) {
    const tf::boolean_result result = result_of(meshes, text, {.merge_coplanar = true});
    const tf::mesh full = result_of(meshes, text, {.keep_cuts = true}).mesh;
    CHECK(result.certificate);
    CHECK(test::is_clean_solid(result.mesh));
    CHECK(result.mesh.faces.size() <= full.faces.size());
    CHECK(result.face_source.size() == result.mesh.faces.size());
    CHECK(result.face_of_cut_vertex.size() == result.mesh.points.size());
    for (std::size_t p = 0; p < result.mesh.points.size(); ++p)
        CHECK((result.vertex_source[p] == tf::operand_element{}) !=
              (result.face_of_cut_vertex[p] == tf::operand_element{}));
    const auto topology = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    CHECK(topology.components_by_edge ==
          tf::count_topology(full.points.size(), full.faces).components_by_edge);
    return tf::join_equal_points(result.mesh);  // parts that touch share what they touch in
}

/// Points at which no face bends, or only along one straight line, with no third face about.
std::size_t spare_points(const tf::mesh& mesh) {
    std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> edges;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            edges[{std::min(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]),
                   std::max(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3])}]
                .push_back(f);
    std::vector<std::vector<std::uint32_t>> bends(mesh.points.size());
    std::vector<bool> crowded(mesh.points.size(), false);
    for (const auto& [ends, faces] : edges) {
        const auto& [a, b, c] = mesh.faces[faces[0]];
        const auto& p = mesh.points;
        bool flat = faces.size() == 2;
        for (const std::uint32_t q : mesh.faces[faces.back()])
            flat = flat && tf::orient3d(p[a], p[b], p[c], p[q]) == 0;
        if (flat) continue;
        for (const std::uint32_t end : ends) {
            bends[end].push_back(ends[0] == end ? ends[1] : ends[0]);
            if (faces.size() > 2) crowded[end] = true;
        }
    }
    std::size_t count = 0;
    for (std::size_t p = 0; p < bends.size(); ++p) {
        if (crowded[p]) continue;
        const bool straight =
            bends[p].size() == 2 &&
            tf::collinear(mesh.points[p], mesh.points[bends[p][0]], mesh.points[bends[p][1]]);
        if (bends[p].empty() || straight) ++count;
    }
    return count;
}

/// A box with corners on a small lattice: all sorts of contact.
tf::mesh random_tetrahedron(test::random& source) {
    tf::mesh mesh;
    for (int i = 0; i < 4; ++i)
        mesh.points.push_back({source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)});
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return tf::signed_volume(mesh) < 0 ? test::inside_out(mesh) : mesh;
}

/// With each face cut in four `levels` times, where halves are exact.
tf::mesh refined(tf::mesh mesh, int levels) {
    for (; levels > 0; --levels) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, added] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
            const tf::point3 p = mesh.points[a], q = mesh.points[b];
            if (added) mesh.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
            return at->second;
        };
        std::vector<tf::face> faces;
        for (const auto& [a, b, c] : mesh.faces) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.faces = std::move(faces);
    }
    return mesh;
}

}  // namespace

TEST_CASE("simplify: two boxes side by side are one box of twelve faces") {
    const tf::mesh both = simplified({box(1, 1, 1), moved(box(2, 1, 1), {1, 0, 0})}, "a+b");
    CHECK(both.faces.size() == 12);
    CHECK(both.points.size() == 8);
    CHECK(tf::signed_volume(both) == 3.0);
    // A box less its half, and a box whose faces are in many pieces.
    CHECK(simplified({box(2, 1, 1), box(1, 1, 1)}, "a-b").faces.size() == 12);
    CHECK(simplified({refined(box(4, 4, 4), 3)}, "a").faces.size() == 12);
}

TEST_CASE("simplify: what a cut needs stays") {
    const tf::mesh corner = simplified({box(2, 2, 2), moved(box(2, 2, 2), {1, 1, 1})}, "a-b");
    CHECK(corner.points.size() == 14);  // of a cube with a cube cut out of its corner
    CHECK(tf::signed_volume(corner) == 7.0);
    // A hole right through: its rims are holes in faces.
    const tf::mesh holed =
        simplified({refined(box(4, 4, 4), 2), moved(box(2, 2, 6), {1, 1, -1})}, "a-b");
    CHECK(holed.points.size() == 16);
    CHECK(holed.faces.size() == 32);
    CHECK(tf::signed_volume(holed) == 48.0);
    // A pit in the middle of a face: no edge links its rim to that of the face.
    const tf::mesh pit = simplified({box(4, 4, 4), moved(box(2, 2, 2), {1, 1, 3})}, "a-b");
    CHECK(pit.points.size() == 16);
    CHECK(pit.faces.size() == 28);
}

TEST_CASE("simplify: where parts touch, both keep what they share") {
    // The edge of one ends in the middle of an edge of the other, in which four faces meet.
    const tf::mesh touching = simplified({box(1, 1, 2), moved(box(1, 1, 2), {1, 1, 1})}, "a+b");
    CHECK(touching.points.size() == 16);
    CHECK(tf::signed_volume(touching) == 4.0);
    // A corner in the middle of a flat side.
    tf::mesh spike;
    spike.points = {{1, 1, 1}, {2, 1, 3}, {1, 2, 3}, {0, 0, 3}};
    spike.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
    REQUIRE(tf::signed_volume(spike) > 0.0);
    const tf::mesh pierced = simplified({refined(box(2, 2, 1), 1), spike}, "a+b");
    CHECK(pierced.points.size() == 8 + 4);
    CHECK(tf::signed_volume(pierced) == 4.0 + tf::signed_volume(spike));
}

TEST_CASE("simplify: of lattice boxes by any formula, the same volume and nothing spare") {
    test::random source(31);
    for (int round = 0; round < 25; ++round) {
        CAPTURE(round);
        std::vector<tf::mesh> boxes;
        for (int k = 0; k < 4; ++k) boxes.push_back(test::lattice_box(source));
        for (const char* text : {"a+b+c+d", "(a-b)*(c+d)", "a^b^c^d"}) {
            CAPTURE(text);
            const tf::mesh solid = simplified(boxes, text);
            CHECK(tf::signed_volume(solid) == tf::signed_volume(result_of(boxes, text).mesh));
            CHECK(spare_points(solid) == 0);
            const tf::mesh again = simplified({solid}, "a");
            CHECK(again.points.size() == solid.points.size());
            CHECK(again.faces.size() == solid.faces.size());
        }
    }
}

TEST_CASE("simplify: of pyramids in many pieces, the corners of the pyramids and of their cuts") {
    test::random source(32);
    for (int round = 0; round < 25; ++round) {
        CAPTURE(round);
        const tf::mesh a = random_tetrahedron(source), b = random_tetrahedron(source);
        // Coordinates of 20 bits: halves of halves are exact.
        tf::mesh coarse_a = a, coarse_b = b;
        for (tf::mesh* m : {&coarse_a, &coarse_b})
            for (tf::point3& p : m->points)
                for (std::size_t k = 0; k < 3; ++k) p[k] = std::round(p[k] * 0x1p20) * 0x1p-20;
        for (const char* text : {"a+b", "a-b", "a*b"}) {
            CAPTURE(text);
            const tf::mesh plain = simplified({coarse_a, coarse_b}, text);
            const tf::mesh fine = simplified({refined(coarse_a, 2), refined(coarse_b, 2)}, text);
            CHECK(fine.points.size() == plain.points.size());
            CHECK(fine.faces.size() == plain.faces.size());
            CHECK(tf::signed_volume(fine) == doctest::Approx(tf::signed_volume(plain)));
        }
    }
}

TEST_CASE("simplify: faces of different groups stay apart") {
    const std::vector<tf::mesh> boxes{box(1, 1, 1), moved(box(1, 1, 1), {1, 0, 0})};
    std::vector<std::uint32_t> groups(24, 0);
    std::fill(groups.begin() + 12, groups.end(), 1U);
    const tf::boolean_result result =
        result_of(boxes, "a+b", {.merge_coplanar = true, .face_groups = groups});
    CHECK(result.certificate);
    CHECK(result.mesh.points.size() == 12);
    CHECK(result.mesh.faces.size() == 20);
    for (std::size_t f = 0; f < result.mesh.faces.size(); ++f)
        for (const std::uint32_t corner : result.mesh.faces[f]) {
            const double x = result.mesh.points[corner].x;
            CHECK((result.face_source[f].operand == 0 ? x <= 1.0 : x >= 1.0));
        }
    groups.pop_back();
    CHECK_THROWS_AS(
        static_cast<void>(result_of(boxes, "a+b", {.merge_coplanar = true, .face_groups = groups})),
        std::invalid_argument);
}

TEST_CASE("simplify: a face of before holds each point that was cut") {
    const std::vector<tf::mesh> boxes{refined(box(2, 2, 2), 2),
                                      moved(box(2, 2, 2), {1.125, 1.125, 1.125})};
    const tf::boolean_result result = result_of(boxes, "a+b", {.merge_coplanar = true});
    std::size_t cut_points = 0;
    for (std::size_t p = 0; p < result.mesh.points.size(); ++p) {
        const auto [operand, index] = result.face_of_cut_vertex[p];
        if (operand == tf::operand_element::none) continue;
        ++cut_points;
        const auto& [a, b, c] = boxes[operand].faces[index];
        const auto& q = boxes[operand].points;
        CHECK(tf::orient3d(q[a], q[b], q[c], result.mesh.points[p]) == 0);
    }
    CHECK(cut_points > 0);
}

TEST_CASE("cuts: what overlaps in a plane is one, what nothing has cut stays") {
    // Boxes in a row that share their tops and bottoms.
    std::vector<tf::mesh> row;
    for (int k = 0; k < 8; ++k) row.push_back(moved(box(2, 1, 1), {1.0 * k, 0, 0}));
    const tf::boolean_result merged = result_of(row, "a+b+c+d+e+f+g+h");
    CHECK(merged.certificate);
    CHECK(merged.mesh.faces.size() == 12);
    CHECK(merged.face_of_cut_vertex.size() == 8);
    CHECK(result_of(row, "a+b+c+d+e+f+g+h", {.keep_cuts = true}).mesh.faces.size() > 60);
    // A pit in one of 512 faces.
    const tf::mesh fine = refined(box(8, 8, 8), 3);
    const tf::mesh pit = moved(box(0.25, 0.125, 1), {0.5, 0.25, 7.5});
    const tf::boolean_result made = result_of({fine, pit}, "a-b");
    CHECK(made.certificate);
    CHECK(made.mesh.points.size() == fine.points.size() + 8);
    std::size_t of_fine = 0;
    for (const tf::operand_element& source : made.vertex_source) of_fine += source.operand == 0;
    CHECK(of_fine == fine.points.size());
}

TEST_CASE(
    "cuts: of lattice boxes by any formula, the same solid with fewer faces, in their groups") {
    test::random source(35);
    std::size_t faces_as_cut = 0, faces = 0;
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        std::vector<tf::mesh> boxes;
        for (int k = 0; k < 4; ++k) boxes.push_back(test::lattice_box(source));
        std::vector<std::uint32_t> groups;
        for (std::uint32_t k = 0; k < 4; ++k) groups.insert(groups.end(), 12, k % 2);
        for (const char* text : {"a+b+c+d", "(a-b)*(c+d)", "a^b^c^d"}) {
            CAPTURE(text);
            const tf::boolean_result as_cut = result_of(boxes, text, {.keep_cuts = true});
            const tf::boolean_result made = result_of(boxes, text);
            const tf::boolean_result grouped = result_of(boxes, text, {.face_groups = groups});
            CHECK(made.certificate);
            CHECK(test::is_clean_solid(made.mesh));
            CHECK(test::is_clean_solid(grouped.mesh));
            CHECK(tf::signed_volume(made.mesh) == tf::signed_volume(as_cut.mesh));
            CHECK(tf::signed_volume(grouped.mesh) == tf::signed_volume(as_cut.mesh));
            std::array<double, 2> area{}, area_grouped{};
            const auto add = [](const tf::boolean_result& of, std::array<double, 2>& to) {
                for (std::size_t f = 0; f < of.mesh.faces.size(); ++f) {
                    const auto& [a, b, c] = of.mesh.faces[f];
                    const auto& p = of.mesh.points;
                    const tf::mesh one{{p[a], p[b], p[c]}, {{0, 1, 2}}};
                    to[of.face_source[f].operand % 2] += tf::surface_area(one);
                }
            };
            add(as_cut, area);
            add(grouped, area_grouped);
            for (std::size_t k = 0; k < 2; ++k) CHECK(area_grouped[k] == doctest::Approx(area[k]));
            CHECK(made.mesh.faces.size() <= grouped.mesh.faces.size());
            CHECK(grouped.mesh.faces.size() <= as_cut.mesh.faces.size());
            faces_as_cut += as_cut.mesh.faces.size();
            faces += made.mesh.faces.size();
        }
    }
    CHECK(faces * 4 < faces_as_cut * 3);
}

TEST_CASE("simplify: nothing, and one thread or many") {
    CHECK(result_of({tf::mesh{}}, "a", {.merge_coplanar = true}).certificate);
    CHECK(result_of({box(1, 1, 1), box(1, 1, 1)}, "a-b", {.merge_coplanar = true}).mesh ==
          tf::mesh{});
    test::random source(33);
    std::vector<tf::mesh> boxes;
    for (int k = 0; k < 12; ++k) boxes.push_back(refined(test::lattice_box(source), 3));
    const std::string text = "a+b+c+d-e-f-g+h+i-j+k-l";
    const tf::boolean_result expected = result_of(boxes, text, {.merge_coplanar = true});
    CHECK(expected.certificate);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::boolean_result found = result_of(boxes, text, {.merge_coplanar = true});
        CHECK(found.mesh == expected.mesh);
        CHECK(found.face_source == expected.face_source);
    }
}
