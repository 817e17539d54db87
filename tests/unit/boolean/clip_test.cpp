#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::together;

/// n x n squares of the plane z = height, from (x, y) on.
tf::mesh sheet(std::uint32_t n, double x, double y, double height) {
    tf::mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({x + i, y + j, height});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            mesh.faces.push_back({a, a + 1, a + n + 2});
            mesh.faces.push_back({a, a + n + 2, a + n + 1});
        }
    return mesh;
}

double area_of(const tf::mesh& mesh) {
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.faces) {
        const tf::point3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
        const tf::point3 u{q.x - p.x, q.y - p.y, q.z - p.z}, v{r.x - p.x, r.y - p.y, r.z - p.z};
        area += std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
    }
    return area;
}

tf::boolean_result clipped(const std::vector<tf::mesh>& meshes, const std::string& text,
                           std::uint32_t which = 0, const tf::boolean_options& options = {}) {
    const tf::boolean_result result =
        tf::clip(std::vector<tf::mesh_view>(meshes.begin(), meshes.end()), which,
                 {text, meshes.size()}, options);
    CHECK(static_cast<bool>(result.certificate) == result.certificate.open_edges.empty());
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    for (const tf::operand_element& source : result.face_source) CHECK(source.operand == which);
    return result;
}

}  // namespace

TEST_CASE("clip: a solid cuts a piece out of a sheet, or leaves it alone") {
    const tf::mesh flat = sheet(4, 0, 0, 1);
    const tf::mesh b = moved(box(2, 2, 2), {1, 1, 0});
    const auto outside = clipped({flat, b}, "a-b"), inside = clipped({flat, b}, "a*b");
    CHECK(area_of(outside.mesh) == 12.0);
    CHECK(area_of(inside.mesh) == 4.0);
    for (const tf::mesh& part : {outside.mesh, inside.mesh})
        for (const auto& [i, j, k] : part.faces)
            CHECK(tf::orient2d(2, part.points[i], part.points[j], part.points[k]) == 1);
    CHECK(area_of(clipped({b, flat}, "b-a", 1).mesh) == 12.0);
    CHECK(area_of(clipped({flat, b, moved(b, {1, 0, 0})}, "(a-b)*c").mesh) == 2.0);
    // Far away, and around everything.
    CHECK(clipped({flat, moved(b, {9, 9, 9})}, "a-b").mesh == flat);
    CHECK(clipped({flat, moved(box(20, 20, 20), {-9, -9, -9})}, "a*b").mesh == flat);
    CHECK(clipped({flat, moved(box(20, 20, 20), {-9, -9, -9})}, "a-b").mesh == tf::mesh{});
}

TEST_CASE("clip: what lies on the surface of a solid is in it") {
    const tf::mesh flat = sheet(4, 0, 0, 2);
    for (const double z : {0.0, 2.0}) {  // below and above the sheet
        const tf::mesh b = moved(box(2, 2, 2), {1, 1, z});
        CHECK(area_of(clipped({flat, b}, "a*b").mesh) == 4.0);
        CHECK(area_of(clipped({b, flat}, "b*a", 1).mesh) == 4.0);
        CHECK(area_of(clipped({flat, b}, "a-b").mesh) == 12.0);
    }
}

TEST_CASE("clip: of sheets and boxes at random, pieces are where they should be") {
    test::random source(51);
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        tf::mesh rough = sheet(4, -2, -2, 0);
        for (tf::point3& p : rough.points) p.z = source.in(-0.5, 0.5);
        const tf::mesh b = moved(box(source.in(0.5, 3), source.in(0.5, 3), source.in(0.5, 3)),
                                 {source.in(-2, 0), source.in(-2, 0), source.in(-2, 0)});
        const auto outside = clipped({rough, b}, "a-b"), inside = clipped({rough, b}, "a*b");
        CHECK(area_of(outside.mesh) + area_of(inside.mesh) == doctest::Approx(area_of(rough)));
        const tf::tree<3> tree = tf::build_face_tree(b);
        const tf::detail::intersect::point_locator where(b, tree);
        const auto middles_are = [&](const tf::mesh& part, tf::location wanted) {
            for (const auto& [i, j, k] : part.faces) {
                const tf::point3 &p = part.points[i], &q = part.points[j], &r = part.points[k];
                const tf::point3 middle{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3,
                                        (p.z + q.z + r.z) / 3};
                CHECK(where.locate(middle).where == wanted);
            }
        };
        middles_are(outside.mesh, tf::location::outside);
        middles_are(inside.mesh, tf::location::inside);
    }
}

TEST_CASE("clip: where solids overlap, pieces of the sheet are where they should be") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto anywhere = [&](double most) {
            return tf::point3{source.in(-most, most), source.in(-most, most),
                              source.in(-most, most)};
        };
        tf::mesh rough = sheet(12, -6, -6, 0);
        for (tf::point3& p : rough.points) p = {p.x / 4, p.y / 4, source.in(-0.1, 0.1)};
        const tf::mesh b = moved(test::ball(3, 1.0), anywhere(0.2));
        const std::vector<tf::mesh> meshes{rough, b, moved(test::ball(3, 0.8), anywhere(0.5)),
                                           moved(box(1, 1, 1), anywhere(0.3))};
        const tf::tree<3> tree = tf::build_face_tree(b);
        const tf::detail::intersect::point_locator where(b, tree);
        const auto check = [&](const std::string& text, tf::location wanted) {
            const tf::boolean_result part = clipped(meshes, text);
            CHECK(!part.mesh.faces.empty());
            for (const auto& [i, j, k] : part.mesh.faces) {
                const auto &p = part.mesh.points[i], &q = part.mesh.points[j],
                           &r = part.mesh.points[k];
                const tf::point3 middle{(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3,
                                        (p.z + q.z + r.z) / 3};
                CHECK(where.locate(middle).where == wanted);
            }
            return area_of(part.mesh);
        };
        const double outside = check("a-b-(c*d-c)", tf::location::outside),
                     inside = check("a*b-(c*d-c)", tf::location::inside);
        CHECK(outside + inside == doctest::Approx(area_of(rough)));
    }
}

TEST_CASE("clip: a sheet may overlap itself, and be closed") {
    const tf::mesh twice = together(sheet(4, 0, 0, 1), sheet(4, 2, 0, 1));
    CHECK(area_of(clipped({twice, moved(box(2, 4, 2), {3, 0, 0})}, "a-b").mesh) == 16.0);
    const tf::mesh b = box(2, 2, 2);
    CHECK(area_of(clipped({b, moved(b, {1, 0, 0})}, "a-b").mesh) == 12.0);
    // Crossing itself.
    tf::mesh cross = sheet(2, 0, 0, 0);
    for (tf::point3& p : cross.points) p.z = p.x - 1;
    const double area = area_of(cross);
    cross = together(cross, sheet(2, 0, 0, 0));
    CHECK(area_of(clipped({cross, moved(box(1, 1, 1), {5, 5, 5})}, "a-b").mesh) ==
          doctest::Approx(area + 4));
}

TEST_CASE("clip: faces of solids that the sheet does not reach are not looked at") {
    const tf::mesh ball = test::ball(5, 1.0);
    const tf::mesh small =
        test::scaled(sheet(2, -1, -1, 0), 0.25);  // half a side, about the middle
    const std::vector<tf::mesh> meshes{moved(small, {0.9, 0, 0}), ball, moved(ball, {0, 0, 1.0}),
                                       moved(ball, {0, 0.1, -1.0})};
    for (const std::string text : {"a*(b+c+d)", "a-b-c-d", "a*(c^d)-b"}) {
        CAPTURE(text);
        const tf::boolean_result result = clipped(meshes, text);
        CHECK(result.statistics.skipped_faces > 3 * ball.faces.size() * 9 / 10);
        CHECK(result.statistics.pairs < 500);  // the balls meet in many more
    }
    const double inside = area_of(clipped(meshes, "a*(b+c+d)").mesh);
    CHECK(inside + area_of(clipped(meshes, "a-b-c-d").mesh) == doctest::Approx(0.25));
    CHECK(inside > 0.05);
    CHECK(inside < 0.2);
}

TEST_CASE("clip: simplified, what is left of a square has few faces") {
    const auto result = clipped({sheet(4, 0, 0, 1), moved(box(2, 2, 2), {1, 1, 0})}, "a-b", 0,
                                {.merge_coplanar = true});
    CHECK(result.mesh.points.size() == 8);
    CHECK(result.mesh.faces.size() == 8);
}

TEST_CASE("clip: another open operand is named, and a union refused") {
    tf::mesh open = box(1, 1, 1);
    open.faces.pop_back();
    const auto result = clipped({sheet(2, 0, 0, 5), open}, "a-b");
    CHECK(result.certificate.open_count == 3);
    CHECK(result.certificate.boundary_edges == 3);  // of the solid alone
    CHECK(result.certificate.open_faces[0].operand == 1);
    CHECK(result.mesh == tf::mesh{});
    const tf::mesh b = box(1, 1, 1);
    const std::vector<tf::mesh_view> both{b, b};
    for (const char* text : {"a+b", "a^b", "b-a", "b"})
        CHECK_THROWS_AS(static_cast<void>(tf::clip(both, 0, {text, 2})), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::clip(both, 2, {"a-b", 2})), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::clip(both, 0, {"a", 1})), std::invalid_argument);
}

TEST_CASE("clip: the same bytes on any number of threads") {
    tf::mesh rough = sheet(20, -10, -10, 0);
    test::random source(52);
    for (tf::point3& p : rough.points) p.z = source.in(-2, 2);
    const std::vector<tf::mesh> meshes{rough, test::ball(3, 4.0), moved(box(5, 5, 5), {1, 1, 1})};
    const auto expected = clipped(meshes, "a-b-c");
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(clipped(meshes, "a-b-c").mesh == expected.mesh);
    }
}

TEST_CASE("boolean: the volumes of two operands and of what they make") {
    const tf::mesh b = box(2, 2, 2);
    const auto volumes = [](const tf::mesh& first, const tf::mesh& second,
                            tf::fill_rule rule = tf::fill_rule::nonzero) {
        const std::vector<tf::mesh_view> views{first, second};
        const auto result = tf::boolean(views, {"a-b", 2}, {.fill_rule = rule, .volumes = true});
        REQUIRE(result.volumes.has_value());
        CHECK(result.volumes->first + result.volumes->second ==
              doctest::Approx(result.volumes->either + result.volumes->both));
        return *result.volumes;
    };
    const tf::operand_volumes crossing = volumes(b, moved(b, {1, 1, 1}));
    CHECK(crossing.first == 8.0);
    CHECK(crossing.second == 8.0);
    CHECK(crossing.either == 15.0);
    CHECK(crossing.both == 1.0);
    // An operand that overlaps itself, and one that is inside out.
    const tf::mesh twice = together(b, moved(b, {1, 0, 0}));
    CHECK(volumes(twice, b).first == 12.0);
    CHECK(volumes(twice, b, tf::fill_rule::even_odd).first == 8.0);
    const tf::mesh turned = test::inside_out(b);
    CHECK(volumes(b, turned).second == 8.0);
    CHECK(volumes(b, turned, tf::fill_rule::positive).second == 0.0);
    const std::vector<tf::mesh_view> three{b, b, b};
    CHECK(!tf::boolean(three, {"a-b", 3}, {.volumes = true}).volumes.has_value());
    test::random source(53);
    for (int round = 0; round < 10; ++round) {
        const tf::mesh ball = test::ball(2, source.in(0.5, 1.5));
        const tf::operand_volumes v =
            volumes(ball, moved(test::ball(2, 1.0), {source.in(-1, 1), source.in(-1, 1), 0.1}));
        CHECK(std::abs(v.first + v.second - v.either - v.both) <= 0x1p-45);
    }
}
