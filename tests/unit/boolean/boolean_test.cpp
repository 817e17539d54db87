#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/was_mended.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::box;
using test::inside_out;
using test::lattice_box;
using test::moved;
using test::together;
using test::turned;
using tf::boolean_expression;

std::vector<tf::mesh_view> views_of(const std::vector<tf::mesh>& meshes) {
    return {meshes.begin(), meshes.end()};
}

tf::boolean_result evaluate(const std::vector<tf::mesh>& meshes, const std::string& text,
                            const tf::boolean_options& options = {}) {
    return tf::boolean(views_of(meshes), {text, meshes.size()}, options);
}

/// The surface, after a look at whether it is what the result says.
tf::mesh solid_of(const std::vector<tf::mesh>& meshes, const std::string& text,
                  const tf::boolean_options& options = {}) {
    const tf::boolean_result result = evaluate(meshes, text, options);
    // Two bricks of a wall may have less in common than rounding keeps.
    const bool has_vanished = result.certificate.status == tf::status::vanished;
    CHECK((result.certificate || has_vanished));
    CHECK(has_vanished == (result.mesh.faces.empty() && result.statistics.exact_faces > 0));
    CHECK(result.certificate.open_edges.empty());
    CHECK(test::is_clean_solid(result.mesh));
    CHECK(result.face_source.size() == result.mesh.faces.size());
    CHECK(result.vertex_source.size() == result.mesh.points.size());
    for (std::size_t p = 0; p < result.mesh.points.size(); ++p) {
        const tf::operand_element source = result.vertex_source[p];
        if (source == tf::operand_element{} || options.precision == tf::precision::float32 ||
            test::was_mended(result.statistics))
            continue;
        CHECK(result.mesh.points[p] == meshes[source.operand].points[source.index]);
    }
    return result.mesh;
}

double volume_of(const std::vector<tf::mesh>& meshes, const std::string& text) {
    return tf::signed_volume(solid_of(meshes, text));
}

/// [union, intersection, a without b, b without a, either]
std::array<double, 5> volumes(const tf::mesh& a, const tf::mesh& b) {
    return {volume_of({a, b}, "a+b"), volume_of({a, b}, "a*b"), volume_of({a, b}, "a-b"),
            volume_of({a, b}, "b-a"), volume_of({a, b}, "a^b")};
}

using five = std::array<double, 5>;

tf::mesh random_box(test::random& source) {
    const tf::mesh b = box(source.in(0.5, 1.5), source.in(0.5, 1.5), source.in(0.5, 1.5));
    const tf::point3 axis{source.in(-1, 1), source.in(-1, 1), source.in(0.1, 1)};
    return moved(turned(b, axis, source.in(0, 3)),
                 {source.in(-0.7, 0.7), source.in(-0.7, 0.7), source.in(-0.7, 0.7)});
}

/// Volume by counting unit cells.
template <class Inside>
double lattice_volume(const std::vector<tf::mesh>& boxes, Inside inside) {
    double count = 0.0;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
            for (int z = 0; z < 8; ++z) {
                std::vector<bool> in;
                for (const tf::mesh& b : boxes) {
                    const tf::point3 &low = b.points.front(), &high = b.points.back();
                    in.push_back(low.x <= x && x < high.x && low.y <= y && y < high.y &&
                                 low.z <= z && z < high.z);
                }
                count += inside(in) ? 1.0 : 0.0;
            }
    return count;
}

bool same(const tf::boolean_result& a, const tf::boolean_result& b) {
    return a.mesh == b.mesh && a.face_source == b.face_source &&
           a.vertex_source == b.vertex_source &&
           a.certificate.max_displacement == b.certificate.max_displacement;
}

}  // namespace

TEST_CASE("boolean: boxes that are apart, touch in every way, or share faces") {
    const tf::mesh b = box(1, 1, 1);
    CHECK(volumes(b, moved(b, {2, 0, 0})) == five{2, 0, 1, 1, 2});            // apart
    CHECK(volumes(b, moved(b, {1, 0, 0})) == five{2, 0, 1, 1, 2});            // share a face
    CHECK(volumes(b, moved(b, {1, 0.5, 0})) == five{2, 0, 1, 1, 2});          // a part of one
    CHECK(volumes(b, moved(b, {1, 0.5, 0.25})) == five{2, 0, 1, 1, 2});       // of both its sides
    CHECK(volumes(b, moved(b, {1, 1, 0})) == five{2, 0, 1, 1, 2});            // an edge
    CHECK(volumes(b, moved(b, {1, 1, 0.5})) == five{2, 0, 1, 1, 2});          // a part of one
    CHECK(volumes(b, moved(b, {1, 1, 1})) == five{2, 0, 1, 1, 2});            // a corner
    CHECK(volumes(b, b) == five{1, 1, 0, 0, 0});                              // identical
    CHECK(volumes(b, moved(b, {0.5, 0, 0})) == five{1.5, 0.5, 0.5, 0.5, 1});  // four planes
    CHECK(volumes(b, moved(b, {0.5, 0.5, 0})) == five{1.75, 0.25, 0.75, 0.75, 1.5});  // two
    CHECK(volumes(b, moved(b, {0.5, 0.5, 0.5})) == five{1.875, 0.125, 0.875, 0.875, 1.75});
    CHECK(volumes(b, box(0.5, 0.5, 0.5)) == five{1, 0.125, 0.875, 0, 0.875});  // in its corner
    const tf::mesh inner = moved(box(0.5, 0.5, 0.5), {0.25, 0.25, 0.25});
    CHECK(volumes(b, inner) == five{1, 0.125, 0.875, 0, 0.875});  // nested
    CHECK(volumes(b, moved(box(0.5, 0.5, 1), {0.25, 0.25, 0})) ==
          five{1, 0.25, 0.75, 0, 0.75});  // right through
}

TEST_CASE("boolean: at 45 degrees, through edges and corners of each other") {
    tf::mesh diamond;  // |x - 1| + |y - 1| <= 1, 0 <= z <= 2
    diamond.points = {{0, 1, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0},
                      {0, 1, 2}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}};
    diamond.faces = {{0, 3, 1}, {1, 3, 2}, {4, 5, 7}, {5, 6, 7}, {0, 1, 4}, {1, 5, 4},
                     {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}};
    CHECK(tf::signed_volume(diamond) == 4.0);
    CHECK(volumes(diamond, box(2, 2, 2)) == five{8, 4, 0, 4, 4});
    CHECK(volumes(diamond, box(1, 1, 2)) == five{5, 1, 3, 1, 4});
    CHECK(volumes(diamond, moved(box(2, 2, 1), {0, 0, 1})) == five{6, 2, 2, 2, 4});
    CHECK(volumes(diamond, moved(box(2, 2, 2), {1, 1, 0})) == five{11, 1, 3, 7, 10});
}

TEST_CASE("boolean: of lattice boxes by any formula, as many cells as counting finds") {
    test::random source(3);
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        std::vector<tf::mesh> boxes;
        for (int k = 0; k < 4; ++k) boxes.push_back(lattice_box(source));
        CHECK(volume_of(boxes, "a+b+c+d") == lattice_volume(boxes, [](const auto& in) {
                  return in[0] || in[1] || in[2] || in[3];
              }));
        CHECK(volume_of(boxes, "(a-b)*(c+d)") == lattice_volume(boxes, [](const auto& in) {
                  return in[0] && !in[1] && (in[2] || in[3]);
              }));
        CHECK(volume_of(boxes, "a^b^c^d") == lattice_volume(boxes, [](const auto& in) {
                  return (in[0] != in[1]) != (in[2] != in[3]);
              }));
    }
}

TEST_CASE("boolean: of turned boxes, volumes add up and points are where they should be") {
    test::random source(4);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        const tf::mesh a = random_box(source), b = random_box(source);
        const double va = tf::signed_volume(a), vb = tf::signed_volume(b);
        const auto [both, common, first, second, either] = volumes(a, b);
        // The vertices of these boxes' cuts move by units of 2^-53, their volumes by areas times
        // that.
        const double most = 0x1p-46;
        CHECK(std::abs(va + vb - both - common) <= most);
        CHECK(std::abs(va - common - first) <= most);
        CHECK(std::abs(vb - common - second) <= most);
        CHECK(std::abs(first + second - either) <= most);

        const tf::mesh solid = solid_of({a, b}, "a-b");
        const tf::tree<3> tree_a = tf::build_face_tree(a), tree_b = tf::build_face_tree(b),
                          tree = tf::build_face_tree(solid);
        const tf::detail::intersect::point_locator in_a(a, tree_a), in_b(b, tree_b),
            in_solid(solid, tree);
        for (int i = 0; i < 100; ++i) {
            const tf::point3 p{source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)};
            CHECK(in_solid.locate(p).winding ==
                  (in_a.locate(p).winding - in_b.locate(p).winding == 1 ? 1 : 0));
        }
    }
}

TEST_CASE("boolean: many turned boxes at once give what one after the other gives") {
    test::random source(5);
    std::vector<tf::mesh> boxes;
    for (int k = 0; k < 6; ++k) boxes.push_back(random_box(source));
    const double at_once = volume_of(boxes, "a+b+c+d+e+f");
    tf::mesh all = boxes[0];
    for (std::size_t k = 1; k < boxes.size(); ++k) all = solid_of({all, boxes[k]}, "a+b");
    CHECK(std::abs(tf::signed_volume(all) - at_once) <= 0x1p-44);
    // The same in one mesh that overlaps itself.
    tf::mesh heap;
    for (const tf::mesh& b : boxes) heap = together(heap, b);
    CHECK(std::abs(volume_of({heap}, "a") - at_once) <= 0x1p-44);
}

TEST_CASE("boolean: a result is an operand again, many times over") {
    tf::mesh row = box(1, 1, 1);
    const tf::mesh tile = turned(box(1.1, 1, 1), {1, 0, 0}, 0.01);
    for (int k = 1; k < 12; ++k) row = solid_of({row, moved(tile, {k * 1.0, 0, 0})}, "a+b");
    CHECK(tf::count_topology(row.points.size(), row.faces).components_by_point == 1);
}

TEST_CASE("boolean: what is inside follows the rule") {
    const tf::mesh b = box(2, 2, 2);
    const std::vector<tf::mesh> twice{together(b, moved(b, {1, 0, 0}))};
    const auto volume = [](const std::vector<tf::mesh>& meshes, tf::fill_rule rule) {
        return tf::signed_volume(solid_of(meshes, "a", {.fill_rule = rule}));
    };
    CHECK(volume(twice, tf::fill_rule::nonzero) == 12.0);
    CHECK(volume(twice, tf::fill_rule::positive) == 12.0);
    CHECK(volume(twice, tf::fill_rule::even_odd) == 8.0);
    const std::vector<tf::mesh> turned_out{inside_out(b)};
    CHECK(volume(turned_out, tf::fill_rule::nonzero) == 8.0);
    CHECK(volume(turned_out, tf::fill_rule::positive) == 0.0);
    CHECK(volume(turned_out, tf::fill_rule::even_odd) == 8.0);
    const std::vector<tf::mesh> cavity{
        together(b, moved(inside_out(box(1, 1, 1)), {0.5, 0.5, 0.5}))};
    CHECK(volume(cavity, tf::fill_rule::nonzero) == 7.0);
    const std::vector<tf::mesh> both_outward{together(b, moved(box(1, 1, 1), {0.5, 0.5, 0.5}))};
    CHECK(volume(both_outward, tf::fill_rule::nonzero) == 8.0);
    CHECK(volume(both_outward, tf::fill_rule::even_odd) == 7.0);
}

TEST_CASE("boolean: a clean mesh alone comes back as it is") {
    const tf::mesh ball = test::ball(3, 1.7);
    const tf::boolean_result result = evaluate({ball}, "a");
    CHECK(result.certificate);
    CHECK(result.mesh == ball);
    CHECK(result.certificate.max_displacement == 0.0);
    CHECK(result.statistics.pairs == 0);
    for (std::uint32_t f = 0; f < ball.faces.size(); ++f)
        CHECK(result.face_source[f] == tf::operand_element{0, f});
    for (std::uint32_t p = 0; p < ball.points.size(); ++p)
        CHECK(result.vertex_source[p] == tf::operand_element{0, p});
}

TEST_CASE("boolean: sources are faces of the operand that the face lies in") {
    const std::vector<tf::mesh> meshes{box(2, 2, 2), moved(box(2, 2, 2), {1, 1, 1})};
    const tf::boolean_result result = evaluate(meshes, "a-b");
    std::array<int, 2> faces_of{};
    for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
        const auto [operand, index] = result.face_source[f];
        ++faces_of[operand];
        const auto& [i, j, k] = meshes[operand].faces[index];
        const auto& points = meshes[operand].points;
        for (const std::uint32_t corner : result.mesh.faces[f])
            CHECK(tf::orient3d(points[i], points[j], points[k], result.mesh.points[corner]) == 0);
    }
    CHECK(faces_of[0] > 0);
    CHECK(faces_of[1] > 0);
}

TEST_CASE("boolean: floats are floats, and certified as such") {
    test::random source(6);
    for (int round = 0; round < 8; ++round) {
        CAPTURE(round);
        const std::vector<tf::mesh> boxes{random_box(source), random_box(source),
                                          random_box(source)};
        const tf::mesh solid = solid_of(boxes, "a+b-c", {.precision = tf::precision::float32});
        for (const tf::point3& p : solid.points)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto single = static_cast<float>(p[k]);
                CHECK(static_cast<double>(single) == p[k]);
            }
        CHECK(std::abs(tf::signed_volume(solid) - volume_of(boxes, "a+b-c")) < 1e-5);
    }
}

TEST_CASE("boolean: surfaces that nearly coincide are mended until they are certified") {
    // Turned by less than what the points can show: cuts everywhere, and next to each other.
    const tf::mesh ball = test::ball(3, 1.0);
    for (const double angle : {1e-3, 1e-9, 1e-14, 3e-16}) {
        CAPTURE(angle);
        const tf::mesh other = turned(ball, {1, 2, 3}, angle);
        const double v = tf::signed_volume(ball);
        CHECK(volume_of({ball, other}, "a+b") >= v * (1 - 1e-12));
        CHECK(volume_of({ball, other}, "a*b") <= v * (1 + 1e-12));
    }
}

TEST_CASE("boolean: turned boxes whose faces lie in each other's planes are mended, too") {
    // Turned, no two faces are in one plane any more, but all are next to one.
    test::random source(8);
    for (int round = 0; round < 10; ++round) {
        CAPTURE(round);
        std::vector<tf::mesh> boxes, turned_boxes;
        const tf::point3 axis{source.in(-1, 1), source.in(-1, 1), source.in(0.1, 1)};
        const double angle = source.in(0, 3);
        for (int k = 0; k < 4; ++k) {
            boxes.push_back(lattice_box(source));
            turned_boxes.push_back(turned(boxes.back(), axis, angle));
        }
        const double volume =
            lattice_volume(boxes, [](const auto& in) { return in[0] || in[1] || in[2] || in[3]; });
        CHECK(std::abs(volume_of(turned_boxes, "a+b+c+d") - volume) <= 1e-11);
        const tf::mesh single =
            solid_of(turned_boxes, "a+b+c+d", {.precision = tf::precision::float32});
        CHECK(std::abs(tf::signed_volume(single) - volume) <= 1e-3);
        const double symmetric = lattice_volume(
            boxes, [](const auto& in) { return (in[0] != in[1]) != (in[2] != in[3]); });
        CHECK(std::abs(volume_of(turned_boxes, "a^b^c^d") - symmetric) <= 1e-11);
    }
}

TEST_CASE("boolean: a wall of turned bricks grows brick by brick") {
    test::random source(9);
    const tf::point3 axis{0.3, -0.8, 0.5};
    tf::mesh wall;
    for (int k = 0; k < 16; ++k) {
        CAPTURE(k);
        const auto whole = [&](std::size_t n) { return static_cast<double>(source.below(n)); };
        const tf::mesh brick =
            turned(moved(box(1 + whole(2), 1, 1), {whole(6) / 2, whole(4), whole(5)}), axis, 0.7);
        const double common = volume_of({wall, brick}, "a*b");
        const double sum = tf::signed_volume(wall) + tf::signed_volume(brick);
        wall = solid_of({wall, brick}, "a+b");
        CHECK(std::abs(tf::signed_volume(wall) + common - sum) <= 1e-11);
    }
}

TEST_CASE("boolean: nothing comes of nothing, and faces without an area bound nothing") {
    const tf::boolean_result nothing = tf::boolean({}, boolean_expression::union_of(0));
    CHECK(nothing.certificate);
    CHECK(nothing.mesh == tf::mesh{});
    CHECK(volumes({}, box(1, 1, 1)) == five{1, 0, 0, 1, 1});
    tf::mesh flaps = box(1, 1, 1);
    flaps.points.push_back({0.5, 0, 0});
    flaps.faces.insert(flaps.faces.end(), {{0, 1, 8}, {0, 8, 1}, {3, 3, 5}});
    const tf::boolean_result result =
        evaluate({flaps, moved(box(1, 1, 1), {0.5, 0.5, 0.5})}, "a-b");
    CHECK(result.certificate);
    CHECK(result.statistics.degenerate == 3);
    CHECK(tf::signed_volume(result.mesh) == 0.875);
}

TEST_CASE("boolean: open operands are named with the place") {
    tf::mesh open = box(1, 1, 1);
    open.faces.erase(open.faces.begin() + 5);
    const tf::boolean_result result = evaluate({box(3, 3, 3), open}, "a-b");
    CHECK_FALSE(result.certificate);
    CHECK(result.mesh == tf::mesh{});
    REQUIRE(result.certificate.open_count == 3);
    REQUIRE(result.certificate.open_edges.size() == 3);
    REQUIRE(result.certificate.open_faces.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [operand, face] = result.certificate.open_faces[i];
        CHECK(operand == 1);
        const auto holds = [&, f = open.faces[face]](const tf::point3& p) {
            return std::any_of(f.begin(), f.end(),
                               [&](std::uint32_t c) { return open.points[c] == p; });
        };
        for (const tf::point3& end : result.certificate.open_edges[i]) CHECK(holds(end));
    }
    CHECK(tf::check_operand(open).open_count == 3);
    CHECK(tf::check_operand(box(1, 1, 1)).open_edges.empty());
    CHECK(tf::check_operand(tf::mesh{}).open_edges.empty());
}

TEST_CASE("boolean: open edges are counted as the operand has them, and by what is wrong there") {
    // A box without a face, and a wall through two of its open edges, which stay as they are.
    tf::mesh open = box(2, 2, 2);
    open.faces.erase(open.faces.begin());  // 0, 2, 1
    const tf::certificate plain = tf::check_operand(open);
    CHECK(plain.boundary_edges == 3);
    CHECK(plain.misoriented_edges == 0);
    CHECK(plain.message() ==
          "its surface ends at 3 edges, the first from (0, 0, 0) to (2, 0, 0) at face 3");
    const tf::mesh wall = moved(box(0.5, 4, 4), {0.5, -1, -1});
    const tf::mesh both = together(open, wall);
    const tf::certificate cut = tf::check_operand(both);
    CHECK(cut.open_count == 3);
    CHECK(cut.boundary_edges == 3);
    CHECK(cut.message().starts_with("its surface ends at 3 edges, the first from "));

    tf::mesh odd = box(2, 2, 2);
    std::swap(odd.faces[0][1], odd.faces[0][2]);
    const tf::certificate flipped = tf::check_operand(odd);
    CHECK(flipped.boundary_edges == 0);
    CHECK(flipped.misoriented_edges == 3);
    CHECK(flipped.message().starts_with(
        "its surface is inconsistently oriented at 3 edges, the first from (0, 0, 0) to "));
    CHECK(
        tf::check_operand(together(open, moved(odd, {5, 5, 5})))
            .message()
            .starts_with("its surface ends at 3 edges and is inconsistently oriented at 3 edges"));

    // A point on an open edge that its face does not know: what fits together cannot be told.
    tf::mesh split = box(2, 2, 2);
    split.faces.erase(split.faces.begin() + 1);  // 1, 2, 3
    split.points.push_back({1, 0, 0});
    split.faces[0] = {0, 2, 8};
    split.faces.push_back({8, 2, 1});
    const tf::certificate unknown = tf::check_operand(split);
    CHECK(unknown.open_count == 3);
    CHECK(unknown.boundary_edges == 0);
    CHECK(unknown.message().starts_with("its surface is open at 3 edges, the first "));
}

TEST_CASE("boolean: edges that fit together piece by piece leave nothing open") {
    tf::mesh b = box(2, 2, 2);  // the face 0 2 1 in two, at the middle of edge 0 1
    b.points.push_back({1, 0, 0});
    b.faces[0] = {0, 2, 8};
    b.faces.push_back({8, 2, 1});
    CHECK(tf::find_open_edge(b).has_value());
    CHECK(tf::check_operand(b).open_edges.empty());
    CHECK(volume_of({b}, "a") == 8.0);
}

TEST_CASE("split: every piece stays, and open operands do, too") {
    tf::mesh sheet;  // 4 x 4 at half height
    sheet.points = {{-1, -1, 1}, {3, -1, 1}, {3, 3, 1}, {-1, 3, 1}};
    sheet.faces = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<tf::mesh> meshes{box(2, 2, 2), sheet};
    const tf::boolean_result result = tf::split(views_of(meshes));
    CHECK(result.certificate);
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    double area = 0.0;
    for (const auto& [a, b, c] : result.mesh.faces) {
        const auto& p = result.mesh.points;
        const tf::point3 u{p[b].x - p[a].x, p[b].y - p[a].y, p[b].z - p[a].z};
        const tf::point3 v{p[c].x - p[a].x, p[c].y - p[a].y, p[c].z - p[a].z};
        area += std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
    }
    CHECK(area == doctest::Approx(24.0 + 16.0));
    const auto overlapping = tf::split(views_of({box(1, 1, 1), box(1, 1, 1)}));
    CHECK(overlapping.mesh.points == box(1, 1, 1).points);
    CHECK(overlapping.mesh.faces.size() == 12);
}

TEST_CASE("boolean: what cannot be meant is refused") {
    const tf::mesh b = box(1, 1, 1);
    const std::vector<tf::mesh_view> one{b};
    CHECK_THROWS_AS(static_cast<void>(tf::boolean(one, boolean_expression::union_of(2))),
                    std::invalid_argument);
    tf::mesh bad = b;
    bad.faces[3][1] = 8;
    CHECK_THROWS_AS(static_cast<void>(evaluate({bad}, "a")), std::invalid_argument);
    bad = b;
    bad.points[2].y = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(static_cast<void>(evaluate({bad}, "a")), std::invalid_argument);
    bad.points.push_back(bad.points[2]);  // now used by no face
    bad.points[2] = b.points[2];
    CHECK(evaluate({bad}, "a").mesh == b);
    CHECK(
        evaluate({b, moved(b, {0.5, 0.5, 0.5})}, "a+b", {.progress = [](double) { return false; }})
            .certificate.status == tf::status::cancelled);
}

TEST_CASE("boolean: progress never goes back") {
    double last = 0.0;
    bool rising = true;
    const auto told = [&](double share) {
        rising = rising && share >= last && share <= 1.0;
        last = share;
        return true;
    };
    const tf::mesh ball = test::ball(4, 1.0);
    static_cast<void>(evaluate({ball, turned(ball, {1, 2, 3}, 3e-16)}, "a+b", {.progress = told}));
    CHECK(rising);
}

TEST_CASE("boolean: the same bytes on any number of threads") {
    const tf::mesh ball = test::ball(4, 1.0);
    const std::vector<tf::mesh> meshes{ball, turned(moved(ball, {0.5, 0, 0}), {1, 2, 3}, 0.7),
                                       moved(box(1, 1, 1), {-0.5, -0.5, -0.5})};
    const std::vector<tf::mesh> nearly{ball, turned(ball, {1, 2, 3}, 3e-16)};
    const tf::boolean_result expected = evaluate(meshes, "a+b-c");
    const tf::boolean_result mended = evaluate(nearly, "a+b");
    CHECK(test::was_mended(mended.statistics));
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(same(evaluate(meshes, "a+b-c"), expected));
        CHECK(same(evaluate(nearly, "a+b"), mended));
    }
}

TEST_CASE("boolean: the order of points and faces does not change the solid") {
    test::random source(7);
    const tf::mesh a = random_box(source), b = random_box(source);
    const double volume = volume_of({a, b}, "a-b");
    for (int round = 0; round < 5; ++round) {
        const std::vector<tf::mesh> other{test::shuffled(source, a).mesh,
                                          test::shuffled(source, b).mesh};
        CHECK(std::abs(volume_of(other, "a-b") - volume) <= 0x1p-48);
    }
}

TEST_CASE("boolean: functions of two meshes take many, as a list in braces or a vector") {
    const tf::mesh a = box(4, 1, 1), b = moved(box(4, 1, 1), {1, 0, 0}),
                   c = moved(box(4, 1, 1), {2, 0, 0});
    const std::vector<tf::mesh> parts{a, b, c};
    const auto volume = [](const tf::boolean_result& made) {
        return tf::signed_volume(made.value());
    };
    CHECK(volume(tf::unite(parts)) == 6.0);
    CHECK(volume(tf::unite({a, b, c})) == 6.0);
    CHECK(volume(tf::unite({a, c})) == 6.0);
    CHECK(volume(tf::unite({a, b}, {.merge_coplanar = true})) == 5.0);
    CHECK(tf::unite(a, b).mesh == tf::unite({a, b}).mesh);
    CHECK(tf::unite(a, b, {.merge_coplanar = true}).mesh ==
          tf::unite({a, b}, {.merge_coplanar = true}).mesh);
    CHECK(volume(tf::intersection(parts)) == 2.0);
    CHECK(volume(tf::difference(a, {b, c})) == 1.0);
    CHECK(volume(tf::difference(a, b)) == 1.0);
    CHECK(volume(tf::difference(a, parts[2])) == 2.0);
    CHECK(tf::difference(a, parts).mesh.faces.empty());
    CHECK(volume(tf::difference(a, {})) == 4.0);
    CHECK(tf::unite(std::vector<tf::mesh>{}).mesh.faces.empty());
    CHECK(volume(tf::unite(a)) == 4.0);
}
