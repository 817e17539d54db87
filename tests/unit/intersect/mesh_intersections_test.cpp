/// \file
/// Intersections of two meshes against all pairs looked at one by one, and under moves.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/brute_force.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using pairs = std::vector<tf::face_pair>;

/// The words of `mesh_intersections` as two nested loops.
template <class Common>
pairs by_brute_force(const tf::mesh& a, const tf::mesh& b, const Common& common) {
    const auto triangle = [](const tf::mesh& mesh, std::size_t i) {
        const tf::face& f = mesh.faces[i];
        return tf::triangle3{mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
    };
    pairs found;
    for (std::uint32_t i = 0; i < a.faces.size(); ++i)
        for (std::uint32_t j = 0; j < b.faces.size(); ++j) {
            const test::common_set both = common(triangle(a, i), triangle(b, j));
            if (!both.ends.empty()) found.push_back({i, j, test::kind_of(both, 0)});
        }
    return found;
}

/// The pairs, after the counts and the short answer have been compared with them, and the answer of
/// the same meshes prepared. Those are indexed whole, the others where their boxes overlap.
pairs found_in(const tf::mesh& a, const tf::mesh& b, const tf::face_pair_options& options = {}) {
    const tf::face_pair_result result = tf::mesh_intersections(a, b, options);
    std::array<std::uint64_t, tf::pair_kind_count> counts{};
    for (const tf::face_pair& pair : result.pairs) ++counts[static_cast<std::size_t>(pair.kind)];
    CHECK(result.counts == counts);
    CHECK(result.box_pairs >= result.pairs.size());
    CHECK(tf::intersects(a, b, {options.transform_a, options.transform_b}) ==
          !result.pairs.empty());
    const auto of_prepared =
        tf::mesh_intersections(tf::prepared_mesh::borrow(a), tf::prepared_mesh::borrow(b), options);
    CHECK(of_prepared.pairs == result.pairs);
    CHECK(of_prepared.counts == result.counts);
    if (options.transform_a == tf::transform<3>{} && options.transform_b == tf::transform<3>{})
        CHECK(of_prepared.box_pairs >= result.box_pairs);
    return result.pairs;
}

tf::mesh image(tf::mesh mesh, const tf::transform<3>& by) {
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

tf::transform<3> random_map(test::random& source) {
    tf::transform<3> map;
    for (auto& row : map.rows)
        for (double& entry : row) entry = source.in(-1, 1);
    return map;
}

/// A turn about two axes, then a move.
tf::transform<3> turned(test::random& source, double reach) {
    const double a = source.in(0.0, 7.0), b = source.in(0.0, 7.0);
    tf::transform<3> first, second;
    first.rows = {
        {{std::cos(a), -std::sin(a), 0, 0}, {std::sin(a), std::cos(a), 0, 0}, {0, 0, 1, 0}}};
    second.rows = {{{1, 0, 0, source.in(-reach, reach)},
                    {0, std::cos(b), -std::sin(b), source.in(-reach, reach)},
                    {0, std::sin(b), std::cos(b), source.in(-reach, reach)}}};
    return second.after(first);
}

/// Triangles whose first corner is about where a face of `mesh` has a point, the others anywhere
/// near.
tf::mesh stands_on(const tf::mesh& mesh, test::random& source, std::size_t count, double size) {
    tf::mesh result;
    for (std::size_t i = 0; i < count; ++i) {
        const tf::face& f = mesh.faces[source.below(mesh.faces.size())];
        const double x = source.in(0, 1), y = source.in(0, 1 - x);
        const auto at = static_cast<std::uint32_t>(result.points.size());
        for (int corner = 0; corner < 3; ++corner) {
            tf::point3 p;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = mesh.points[f[0]][k] * (1 - x - y) + mesh.points[f[1]][k] * x +
                       mesh.points[f[2]][k] * y;
                if (corner != 0) p[k] += source.in(-size, size);
            }
            result.points.push_back(p);
        }
        result.faces.push_back({at, at + 1, at + 2});
    }
    return result;
}

/// A closed ball of 8 * 4^n triangles.
tf::mesh ball(int rounds) {
    tf::mesh mesh{
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int round = 0; round < rounds; ++round) {
        tf::mesh finer;
        for (const tf::face& f : mesh.faces) {
            const auto at = static_cast<std::uint32_t>(finer.points.size());
            for (std::size_t k = 0; k < 3; ++k) finer.points.push_back(mesh.points[f[k]]);
            for (std::size_t k = 0; k < 3; ++k) {
                const tf::point3& p = mesh.points[f[k]];
                const tf::point3& q = mesh.points[f[(k + 1) % 3]];
                const tf::point3 m{p.x + q.x, p.y + q.y, p.z + q.z};
                const double length = std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
                finer.points.push_back({m.x / length, m.y / length, m.z / length});
            }
            for (const tf::face& part : {tf::face{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
                finer.faces.push_back({at + part[0], at + part[1], at + part[2]});
        }
        mesh = finer;
    }
    return mesh;
}

}  // namespace

TEST_CASE("mesh_intersections: no faces, no pairs") {
    const tf::mesh sheet = test::grid(3);
    CHECK(found_in({}, {}).empty());
    CHECK(found_in(sheet, {}).empty());
    CHECK(found_in({}, sheet).empty());
}

TEST_CASE("mesh_intersections: each kind in its smallest example") {
    const tf::mesh flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
    const auto kind_with = [&](const tf::point3& a, const tf::point3& b, const tf::point3& c) {
        const pairs found = found_in(flat, {{a, b, c}, {{0, 1, 2}}});
        REQUIRE(found.size() == 1);
        return found[0].kind;
    };
    CHECK(kind_with({1, 1, -1}, {1, 1, 1}, {4, 4, 1}) == tf::pair_kind::crossing);
    CHECK(kind_with({1, 1, 0}, {2, 1, 0}, {4, 4, 0}) == tf::pair_kind::overlap);
    CHECK(kind_with({0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == tf::pair_kind::overlap);
    CHECK(kind_with({1, 1, 0}, {1, 2, 4}, {-1, 3, 3}) == tf::pair_kind::touching);
    CHECK(kind_with({0, 0, 0}, {4, 0, 0}, {0, -4, 0}) == tf::pair_kind::touching);
    CHECK(kind_with({0, 0, 0}, {-1, 0, 0}, {0, -1, 5}) == tf::pair_kind::touching);
    CHECK(kind_with({1, 1, -1}, {1, 1, 1}, {1, 1, 1}) == tf::pair_kind::degenerate);
    const double below = -std::numeric_limits<double>::denorm_min();
    CHECK(found_in(flat, {{{1, 1, below}, {1, 2, -4}, {-1, 3, -3}}, {{0, 1, 2}}}).empty());
}

TEST_CASE("mesh_intersections: lattice soups as an independent intersection finds them") {
    std::array<std::size_t, tf::pair_kind_count> seen{};
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh a = test::lattice_soup(source, 40, 12 + seed % 20, 2 + seed % 4);
        const tf::mesh b = test::lattice_soup(source, 50, 12 + seed % 20, 2 + seed % 4);
        const pairs expected = by_brute_force(a, b, test::common_by_reference);
        CHECK(found_in(a, b) == expected);
        for (const tf::face_pair& pair : expected) ++seen[static_cast<std::size_t>(pair.kind)];
    }
    for (const auto kind : {tf::pair_kind::crossing, tf::pair_kind::overlap,
                            tf::pair_kind::touching, tf::pair_kind::degenerate})
        CHECK(seen[static_cast<std::size_t>(kind)] > 100);
}

TEST_CASE("mesh_intersections: other soups as all pairs one by one, at any scale") {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh small = test::random_soup(source, 200, 0.1);
        const tf::mesh wide = test::random_soup(source, 100, 1.0);
        const tf::mesh lattice = test::lattice_soup(source, 200, 150, 7);
        for (const double scale : {1.0, 0.1, 1e-9, 0x1p-700, 0x1p+300, 0x1p+600})
            for (const tf::point3& by : {tf::point3{}, tf::point3{0.25, 0, 1e3}})
                for (const tf::mesh* other : {&wide, &lattice}) {
                    CAPTURE(scale);
                    const tf::mesh a = test::scaled(test::moved(small, by), scale);
                    const tf::mesh b = test::scaled(test::moved(*other, by), scale);
                    CHECK(found_in(a, b) == by_brute_force(a, b, test::common_by_library));
                }
        CHECK(found_in(test::scaled(small, 1e-9), wide) ==
              by_brute_force(test::scaled(small, 1e-9), wide, test::common_by_library));
    }
}

TEST_CASE("mesh_intersections: the two of one mesh side by side in it") {
    test::random source(3);
    const tf::mesh a = test::random_soup(source, 2000, 0.05);
    const tf::mesh b = test::random_soup(source, 1500, 0.05);
    std::vector<std::uint32_t> component(a.faces.size(), 0);
    component.resize(a.faces.size() + b.faces.size(), 1);
    pairs expected = tf::self_intersections(test::together(a, b),
                                            {.component_of_face = component, .between = true})
                         .pairs;
    for (tf::face_pair& pair : expected) pair.b -= static_cast<std::uint32_t>(a.faces.size());
    CHECK(!expected.empty());
    CHECK(found_in(a, b) == expected);
}

TEST_CASE("mesh_intersections: a move gives the pairs of the moved mesh, with the tree as it was") {
    int met = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh a = test::random_soup(source, 400, 0.2);
        const tf::mesh b = test::lattice_soup(source, 100, 60, 2);
        tf::face_pair_options options;
        if (seed % 3 != 0) options.transform_a = random_map(source);
        if (seed % 3 != 1) options.transform_b = random_map(source);
        if (seed == 10)
            options.transform_a.rows[0] = options.transform_a.rows[1];  // everything degenerate
        const pairs found = found_in(a, b, options);
        CHECK(found == found_in(image(a, options.transform_a), image(b, options.transform_b)));
        met += found.empty() ? 0 : 1;
    }
    CHECK(met >= 6);
}

TEST_CASE("mesh_intersections: turned meshes as all pairs of their images one by one") {
    std::size_t met = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const double scale = std::array{1.0, 1e-30, 1e30, 0x1p-250, 0x1p+250}[seed % 5];
        const double fineness = 1.0 / static_cast<double>(2 + 3 * (seed % 3));
        const tf::mesh a = test::scaled(ball(2), scale);
        const tf::mesh b = test::scaled(test::random_soup(source, 120, fineness), scale);
        tf::face_pair_options options;
        if (seed % 2 == 0) options.transform_a = turned(source, scale);
        options.transform_b = turned(source, scale);
        const pairs found = found_in(a, b, options);
        CHECK(found == by_brute_force(image(a, options.transform_a), image(b, options.transform_b),
                                      test::common_by_library));
        met += found.size();
    }
    CHECK(met > 100);
}

TEST_CASE(
    "mesh_intersections: corners that come to lie on a face except for rounding are told apart") {
    std::size_t met = 0, missed = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::point3 far{seed % 2 == 0 ? 0.0 : 1e6, 0, 0};
        const tf::mesh a = test::moved(ball(1), far);
        const tf::mesh b = stands_on(a, source, 300, 0.1);
        const pairs found = found_in(a, b);
        CHECK(found == by_brute_force(a, b, test::common_by_library));
        met += found.size();
        missed += b.faces.size() - std::min(b.faces.size(), found.size());
    }
    CHECK(met > 500);
    CHECK(missed > 100);
}

TEST_CASE("mesh_intersections: flat meshes in one plane, and seen from the side") {
    const tf::mesh sheet = test::grid(6);
    CHECK(!found_in(sheet, test::moved(sheet, {0.25, 0.5, 0})).empty());
    CHECK(
        found_in(sheet, test::moved(sheet, {0.25, 0.5, std::numeric_limits<double>::denorm_min()}))
            .empty());
    tf::face_pair_options upright;
    upright.transform_b.rows = {{{0, 0, 1, 2.5}, {0, 1, 0, 0.25}, {1, 0, 0, -2}}};
    CHECK(!found_in(sheet, sheet, upright).empty());
    tf::mesh line = sheet;  // no face has an area
    for (tf::point3& p : line.points) p.y = p.x;
    CHECK(!found_in(sheet, line).empty());
}

TEST_CASE("intersects: balls that touch in one corner do, a hair apart they do not") {
    const tf::mesh one = ball(3);
    const auto move_by = [](double x) {
        return tf::mesh_pair_options{tf::transform<3>::translation(tf::point3{x, 0, 0}), {}};
    };
    CHECK(tf::intersects(one, one, move_by(2.0)));
    CHECK_FALSE(tf::intersects(one, one, move_by(std::nextafter(2.0, 3.0))));
    CHECK(tf::intersects(one, one, move_by(-2.0)));
    CHECK(tf::intersects(one, one, move_by(1.5)));
    CHECK_FALSE(tf::intersects(one, test::scaled(one, 0.5)));  // inside
    CHECK(found_in(one, one, {.transform_a = tf::transform<3>::translation(tf::point3{2.0, 0, 0})})
              .size() == 16);
}

TEST_CASE("mesh_intersections: threads change nothing, not even the first pair or what was seen") {
    const tf::mesh a = ball(5);
    const tf::mesh b = test::moved(a, {0.5, 0.25, 0.125});
    const auto tree_a = tf::build_face_tree(a), tree_b = tf::build_face_tree(b);
    const auto on = [&](unsigned threads, bool first_only) {
        const tf::thread_scope scope(threads);
        return tf::detail::intersect::mesh_intersections(a, tree_a, b, tree_b,
                                                         {.first_only = first_only});
    };
    const auto all = on(1, false);
    const auto first = on(1, true);
    CHECK(all.pairs.size() > 100);
    REQUIRE(first.pairs.size() == 1);
    CHECK(std::find(all.pairs.begin(), all.pairs.end(), first.pairs[0]) != all.pairs.end());
    CHECK(all.box_pairs < a.faces.size());
    for (const unsigned threads : {2U, 8U}) {
        CHECK(on(threads, false).pairs == all.pairs);
        CHECK(on(threads, false).box_pairs == all.box_pairs);
        CHECK(on(threads, true).pairs == first.pairs);
        const tf::thread_scope scope(threads);
        const tf::prepared_mesh model_a = tf::prepared_mesh::borrow(a),
                                model_b = tf::prepared_mesh::borrow(b);
        CHECK(tf::mesh_intersections(model_a, model_b).pairs == all.pairs);
        CHECK(tf::mesh_intersections(model_a, model_b, {.first_only = true}).pairs == first.pairs);
    }
}

TEST_CASE("mesh_intersections: kinds that are not wanted are not counted, and the limit is kept") {
    test::random source(4);
    const tf::mesh a = test::lattice_soup(source, 60, 30, 4);
    const tf::mesh b = test::lattice_soup(source, 60, 30, 4);
    const auto all = tf::mesh_intersections(a, b);
    const auto some = tf::mesh_intersections(a, b, {.kinds = tf::pair_kind::crossing, .limit = 5});
    pairs crossings = all.pairs;
    std::erase_if(crossings, [](const auto& p) { return p.kind != tf::pair_kind::crossing; });
    REQUIRE(crossings.size() > 5);
    CHECK(some.counts[0] == crossings.size());
    CHECK(some.counts[tf::pair_kind::crossing] == crossings.size());
    CHECK(some.pairs == pairs(crossings.begin(), crossings.begin() + 5));
}

TEST_CASE("mesh_intersections: refuses what it cannot compute with and says what") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh sheet = test::grid(4);
    const auto tree = tf::build_face_tree(sheet);
    tf::mesh bad = sheet;
    bad.faces[7][1] = 1000;
    CHECK_THROWS_WITH_AS((void)tf::build_face_tree(bad), doctest::Contains("face 7"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::detail::intersect::mesh_intersections(sheet, tree, bad, tree),
                         doctest::Contains(": b: face 7"), std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::intersects(tf::mesh{}, sheet, {.transform_a = {{{{nan}}}}}),
                         doctest::Contains("not finite"), std::invalid_argument);
    bad = sheet;
    bad.points[6].y = nan;
    CHECK_THROWS_WITH_AS((void)tf::build_face_tree(bad),
                         doctest::Contains("face 0 has a corner that is not finite"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::detail::intersect::mesh_intersections(bad, tree, sheet, tree),
                         doctest::Contains(": a: face 0"), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::detail::intersect::mesh_intersections({}, tree, sheet, tree),
                    std::invalid_argument);
    const auto far = tf::transform<3>::translation(tf::point3{1.7e308, 0, 0});
    tf::face_pair_options options{.transform_a = far, .transform_b = far};
    options.transform_a.rows[0][0] = 1e308;
    options.transform_b.rows[0][0] = 1e308;
    CHECK_THROWS_AS(
        (void)tf::detail::intersect::mesh_intersections(sheet, tree, sheet, tree, options),
        std::invalid_argument);
    const tf::prepared_mesh model = tf::prepared_mesh::borrow(sheet);
    CHECK_THROWS_AS((void)tf::mesh_intersections(model, model, options), std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::mesh_intersections(model, model, {.transform_a = {{{{nan}}}}}),
                         doctest::Contains("not finite"), std::invalid_argument);
}

TEST_CASE("mesh_intersections: a caller that says stop is heard, and told so") {
    const tf::mesh a = ball(4);
    const auto stop = [](double) { return false; };
    CHECK(tf::mesh_intersections(a, a, {.progress = stop}).status == tf::status::cancelled);
    double last = 0.0;
    CHECK_FALSE(tf::mesh_intersections(a, a,
                                       {.progress =
                                            [&](double done) {
                                                last = done;
                                                return true;
                                            }})
                    .status == tf::status::cancelled);
    CHECK(last == 1.0);
}
