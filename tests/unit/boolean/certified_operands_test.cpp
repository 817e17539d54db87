#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/same_boolean.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/whole_boolean.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;
using test::together;
using operands = std::array<tf::mesh, 2>;

/// As one mesh: of three operands, the last one empty.
tf::boolean_result evaluate_pair(const operands& pair, const std::string& text,
                                 const tf::boolean_options& options) {
    const tf::mesh nothing;
    const std::array<tf::mesh_view, 3> views{pair[0], pair[1], nothing};
    return tf::boolean(views, {text, 3}, options);
}

tf::boolean_result evaluate_prepared(const operands& pair, const std::string& text,
                                     const tf::boolean_options& options) {
    const auto a = tf::prepared_mesh::borrow(pair[0]), b = tf::prepared_mesh::borrow(pair[1]);
    return tf::boolean({a, b}, {text, 2}, options);
}

/// The results are those of all faces, prepared and as one of three, for all formulas that differ.
void check_all_ways(const operands& pair) {
    for (const std::string text : {"a+b", "a*b", "a-b", "b-a", "a^b", "a", "b"}) {
        CAPTURE(text);
        const tf::boolean_result whole = test::whole_boolean({pair[0], pair[1]}, text);
        test::check_same_boolean(evaluate_prepared(pair, text, {}), whole);
        test::check_same_boolean(evaluate_pair(pair, text, {}), whole);
    }
}

/// Turned about an axis through the origin.
tf::mesh rotated(tf::mesh mesh, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (tf::point3& p : mesh.points) {
        p = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
        p = {p.x, p.y * c - p.z * s, p.y * s + p.z * c};
    }
    return mesh;
}

}  // namespace

TEST_CASE("certified operands: apart, nested, equal or empty, the result is that of all faces") {
    check_all_ways({ball(3, 1.0), moved(ball(3, 1.0), {5, 0, 0})});
    check_all_ways({ball(3, 1.0), ball(3, 0.5)});
    check_all_ways({ball(3, 0.5), ball(3, 1.0)});
    check_all_ways({ball(3, 1.0), ball(3, 1.0)});
    check_all_ways({ball(2, 1.0), tf::mesh{}});
    check_all_ways({tf::mesh{}, ball(2, 1.0)});
    check_all_ways({tf::mesh{}, tf::mesh{}});
}

TEST_CASE("certified operands: balls that cross, with parts that do not, give that of all faces") {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto at = [&] {
            return tf::point3{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        };
        tf::mesh a = rotated(ball(3, 1.0), source.in(0, 3));
        a = together(a, moved(ball(2, 0.2), {source.in(1.5, 2), 0, 0}));  // perhaps in b
        tf::mesh b = moved(rotated(ball(4, 1.0), source.in(0, 3)), at());
        b = together(b, moved(ball(1, 0.1), {0, source.in(-3, -2), 0}));
        check_all_ways({a, b});
        check_all_ways({b, a});
    }
}

TEST_CASE(
    "certified operands: loose pieces that are cut off, or out of the middle, need no other way") {
    // All faces of the piece are cut, or next to such; the large ball is far from it.
    const auto check = [](const operands& pair) { check_all_ways(pair); };
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const double angle = source.in(0, 3);
        const tf::mesh large = rotated(ball(3, 1.0), angle);
        const tf::mesh small = rotated(ball(1, 0.1), angle + 1.0);
        const auto aside = [&](double by) {
            return moved(large, {by, source.in(-0.1, 0.1), source.in(-0.1, 0.1)});
        };
        check({together(large, moved(small, {1.95, 0.1, 0.1})), aside(2.95)});
        check({together(large, test::inside_out(moved(small, {0.5, 0.1, 0.1}))), aside(1.5)});
    }
}

TEST_CASE(
    "certified operands: boxes on a lattice, that touch in every way, give that of all faces") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        check_all_ways({test::lattice_box(source), test::lattice_box(source)});
    }
}

TEST_CASE("certified operands: results are certified, with cavities and edges of four faces, too") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        // Whether a part within the region looked at is turned inside out may not be told there.
        const auto check = [](const operands& pair) { check_all_ways(pair); };
        const auto make = [&](const std::string& text) {
            return evaluate_pair({test::lattice_box(source), test::lattice_box(source)}, text, {})
                .mesh;
        };
        const tf::mesh a = make("a^b"), b = make(seed % 2 == 0 ? "a-b" : "a+b");
        check({a, b});
        check({b, a});
        const tf::mesh shell =
            evaluate_pair({moved(box(6, 6, 6), {-0.5, -0.5, -0.5}), test::lattice_box(source)},
                          "a-b", {})
                .mesh;
        check({shell, b});
        check({a, shell});
    }
}

TEST_CASE("certified operands: turned boxes, thin ones too, give that of all faces") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto make = [&] {
            const double thin = seed % 3 == 0 ? 1e-7 : source.in(0.5, 2);
            return moved(rotated(box(source.in(0.5, 2), source.in(0.5, 2), thin), source.in(0, 3)),
                         {source.in(-0.5, 0.5), source.in(-0.5, 0.5), source.in(-0.5, 0.5)});
        };
        check_all_ways({make(), make()});
    }
}

TEST_CASE("certified operands: where rounding breaks something, it is mended") {
    // A ball against itself, moved by less than rounding keeps apart.
    const operands pair{rotated(ball(3, 1.0), 0.7),
                        moved(rotated(ball(3, 1.0), 0.7), {1e-15, 0, 0})};
    const tf::boolean_result general = evaluate_pair(pair, "a+b", {});
    const tf::boolean_result quick = evaluate_prepared(pair, "a+b", {});
    CHECK(quick.certificate.status == general.certificate.status);
    CHECK(quick.mesh == general.mesh);
    const tf::boolean_result floats =
        evaluate_prepared(pair, "a*b", {.precision = tf::precision::float32});
    CHECK(floats.mesh == evaluate_pair(pair, "a*b", {.precision = tf::precision::float32}).mesh);
}

TEST_CASE("certified operands: points that no face uses may be anything, bad ones are refused") {
    operands pair{ball(3, 1.0), moved(ball(3, 1.0), {0.5, 0, 0})};
    const tf::boolean_result before = evaluate_prepared(pair, "a+b", {});
    pair[0].points.push_back({NAN, 0, 0});
    pair[1].points.push_back({1e9, 0, 0});
    const tf::boolean_result after = evaluate_prepared(pair, "a+b", {});
    CHECK(after.mesh == before.mesh);
    CHECK(after.vertex_source == before.vertex_source);
    pair[0].points[7].y = INFINITY;
    CHECK_THROWS_AS(static_cast<void>(evaluate_prepared(pair, "a+b", {})), std::invalid_argument);
    pair[0].faces[3][1] = 1'000'000;
    CHECK_THROWS_AS(static_cast<void>(evaluate_prepared(pair, "a+b", {})), std::invalid_argument);
}

TEST_CASE("certified operands: equal points are one") {
    tf::mesh soup;  // corners of its own for each face
    for (const tf::face& f : ball(2, 1.0).faces)
        for (const std::uint32_t corner : f) soup.points.push_back(ball(2, 1.0).points[corner]);
    for (std::uint32_t i = 0; i < soup.points.size(); i += 3)
        soup.faces.push_back({i, i + 1, i + 2});
    check_all_ways({soup, moved(ball(3, 1.0), {0.3, 0.2, 0.1})});
}

TEST_CASE("certified operands: a second question about prepared meshes builds nothing") {
    const operands pair{ball(3, 1.0), moved(ball(3, 1.0), {0.3, 0.2, 0.1})};
    const auto a = tf::prepared_mesh::borrow(pair[0]), b = tf::prepared_mesh::borrow(pair[1]);
    CHECK(a.indexes_built() == 0);
    CHECK(tf::unite(a, b).certificate);
    const auto built = a.indexes_built() + b.indexes_built();
    CHECK(built ==
          10);  // of each: points without a fan, tree, own pairs, clusters, triangles in leaf order
    CHECK(tf::difference(a, b).certificate);
    CHECK(a.indexes_built() + b.indexes_built() == built);
}

TEST_CASE("certified operands: progress can say stop while it is found out whether they are") {
    const tf::thread_scope one(1);  // else both are looked at side by side
    const operands pair{ball(3, 1.0), moved(ball(3, 1.0), {0.3, 0.2, 0.1})};
    const auto a = tf::prepared_mesh::borrow(pair[0]), b = tf::prepared_mesh::borrow(pair[1]);
    std::vector<double> told;
    const auto until = [&](double limit) {
        return tf::unite(a, b, {.progress = [&told, limit](double done) {
                             told.push_back(done);
                             return done < limit;
                         }});
    };
    CHECK(until(0.1).certificate.status == tf::status::cancelled);
    CHECK(a.indexes_built() == 2);  // its points without a fan and its tree
    CHECK(until(0.5).certificate.status == tf::status::cancelled);
    CHECK(a.indexes_built() == 3);  // its own pairs, too
    CHECK(b.indexes_built() == 2);
    told.clear();
    CHECK(until(2.0).certificate);
    CHECK(b.indexes_built() == 5);
    CHECK(std::ranges::is_sorted(told));
    CHECK(told.back() > 0.3);
    told.clear();
    CHECK(until(2.0).certificate);  // both are known: it starts from 0
    CHECK(told.front() < 0.3);
}

TEST_CASE(
    "certified operands: the same bytes on any number of threads, and progress can say stop") {
    const operands pair{ball(5, 1.0), moved(rotated(ball(5, 1.0), 0.3), {0.4, 0.3, 0.2})};
    const tf::boolean_result all = evaluate_prepared(pair, "a-b", {});
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::boolean_result result = evaluate_prepared(pair, "a-b", {});
        CHECK(result.mesh == all.mesh);
        CHECK(result.face_source == all.face_source);
        CHECK(result.vertex_source == all.vertex_source);
    }
    for (const double limit : {0.0, 0.3, 0.5, 0.7}) {
        const tf::boolean_result stopped =
            evaluate_prepared(pair, "a-b", {.progress = [&](double done) { return done < limit; }});
        CHECK(stopped.certificate.status == tf::status::cancelled);
        CHECK(stopped.mesh.faces.empty());
    }
}
