/// \file
/// Self-intersections against all pairs looked at one by one, and under changes that must not
/// matter.

#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/brute_force.hpp>
#include <support/invariances.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace {

using pairs = std::vector<tf::face_pair>;

/// The pairs, after the counts have been compared with them.
pairs pairs_in(const tf::mesh& mesh) {
    const tf::face_pair_result result =
        tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index});
    std::array<std::uint64_t, tf::pair_kind_count> counts{};
    for (const tf::face_pair& pair : result.pairs) ++counts[static_cast<std::size_t>(pair.kind)];
    CHECK(result.counts == counts);
    CHECK_FALSE(result.status == tf::status::cancelled);
    return result.pairs;
}

pairs of_kind(tf::pair_kind kind, const pairs& all) {
    pairs some;
    for (const tf::face_pair& pair : all)
        if (pair.kind == kind) some.push_back(pair);
    return some;
}

void check_kind(const tf::mesh& mesh, tf::pair_kind kind) {
    CHECK(pairs_in(mesh) == pairs{{0, 1, kind}});
    CHECK(test::pairs_by_brute_force(mesh, test::common_by_reference) == pairs{{0, 1, kind}});
}

}  // namespace

TEST_CASE("self_intersections: no face, one face and neighbors have none") {
    CHECK(pairs_in({}).empty());
    CHECK(pairs_in({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).empty());
    CHECK(pairs_in(test::grid(9)).empty());
    CHECK(pairs_in({{{0, 0, 0}, {0, 0, 0}}, {{0, 1, 0}}}).empty());
}

TEST_CASE("self_intersections: each kind in its smallest example") {
    using tf::pair_kind;
    const std::vector<tf::point3> p{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1},
                                    {1, 1, 1}, {4, 4, 1}, {4, 4, 0}, {1, 1, 0},
                                    {2, 1, 0}, {2, 0, 0}, {1, 2, 4}, {-1, 3, 3}};
    check_kind({p, {{0, 1, 2}, {3, 4, 5}}}, pair_kind::crossing);
    check_kind({p, {{0, 1, 2}, {7, 8, 6}}}, pair_kind::overlap);
    check_kind({p, {{0, 1, 2}, {0, 1, 8}}}, pair_kind::fold);
    check_kind({p, {{0, 1, 2}, {1, 0, 2}}}, pair_kind::duplicate);
    check_kind({p, {{0, 1, 2}, {0, 3, 4}}}, pair_kind::pierce);
    check_kind({p, {{0, 1, 2}, {7, 10, 11}}}, pair_kind::touching);
    check_kind({p, {{0, 1, 2}, {0, 9, 10}}}, pair_kind::touching);
    check_kind({p, {{0, 1, 2}, {3, 4, 4}}}, pair_kind::degenerate);
    CHECK(pairs_in({p, {{0, 1, 2}, {1, 6, 2}}}).empty());  // an edge, on either side of it
    CHECK(pairs_in({p, {{0, 1, 2}, {1, 0, 4}}}).empty());  // an edge, at an angle
    CHECK(pairs_in({p, {{0, 1, 2}, {0, 10, 11}}}).empty());
}

TEST_CASE("self_intersections: corners at one place are shared, unless numbers are asked for") {
    const tf::mesh square = test::grid(1);
    tf::mesh soup = square;
    soup.points.push_back(square.points[0]);
    soup.points.push_back(square.points[3]);
    soup.faces[1] = {4, 5, 2};
    CHECK(pairs_in(square).empty());
    CHECK(pairs_in(soup) == pairs{{0, 1, tf::pair_kind::touching}});
    CHECK(tf::self_intersections(soup).pairs.empty());
    CHECK(tf::self_intersections(tf::prepared_mesh::borrow(soup)).pairs.empty());
}

TEST_CASE(
    "self_intersections: by coordinates, a mesh that repeats its vertices is as one that does "
    "not") {
    test::random source(5);
    for (int round = 0; round < 20; ++round) {
        const tf::mesh mesh = test::lattice_soup(source, 60, 12, 4);
        tf::mesh repeated;
        for (const tf::face& f : mesh.faces) {
            const auto first = static_cast<std::uint32_t>(repeated.points.size());
            for (const std::uint32_t corner : f) repeated.points.push_back(mesh.points[corner]);
            repeated.faces.push_back({first, first + 1, first + 2});
        }
        const pairs expected = tf::self_intersections(tf::join_equal_points(mesh),
                                                      {.vertices = tf::vertex_identity::by_index})
                                   .pairs;
        CHECK(tf::self_intersections(repeated).pairs == expected);
        CHECK(tf::self_intersections(mesh).pairs == expected);
    }
}

TEST_CASE("self_intersections: a second search of a prepared mesh builds nothing") {
    const tf::mesh mesh = test::grid(20);
    const auto ready = tf::prepared_mesh::borrow(mesh);
    CHECK(ready.indexes_built() == 0);
    const auto first = tf::self_intersections(ready);
    const auto built = ready.indexes_built();
    CHECK(built == 2);  // joined corners and the tree
    CHECK(tf::self_intersections(ready).pairs == first.pairs);
    CHECK(ready.indexes_built() == built);
}

TEST_CASE("self_intersections: lattice soups as an independent intersection finds them") {
    std::array<std::size_t, tf::pair_kind_count> seen{};
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 60, 12 + seed % 20, 2 + seed % 4);
        const pairs expected = test::pairs_by_brute_force(soup, test::common_by_reference);
        CHECK(pairs_in(soup) == expected);
        for (const tf::face_pair& pair : expected) ++seen[static_cast<std::size_t>(pair.kind)];
    }
    for (const std::size_t n : seen) CHECK(n > 20);
}

TEST_CASE("self_intersections: other soups as all pairs one by one") {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh lattice = test::lattice_soup(source, 300, 200, 7);
        const tf::mesh sheet = test::grid(8);
        const tf::mesh twice = test::together(sheet, test::moved(sheet, {0.5, 0.25, 0}));
        for (const tf::mesh& mesh :
             {test::random_soup(source, 300, 0.1), test::random_soup(source, 150, 1.0),
              test::fan(source, 150), lattice, test::moved(lattice, {1e6, -1e6, 1e9}),
              test::scaled(lattice, 0.1), twice, test::together(sheet, sheet),
              test::together(test::scaled(lattice, 1e-9), test::random_soup(source, 100, 1.0))}) {
            const pairs found = pairs_in(mesh);
            CHECK(found == test::pairs_by_brute_force(mesh, test::common_by_library));
        }
    }
}

TEST_CASE("self_intersections: order, axes, scale and threads change no pair and no kind") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        for (const tf::mesh& mesh :
             {test::lattice_soup(source, 400, 300, 6), test::random_soup(source, 2000, 0.03),
              test::fan(source, 200), test::scaled(test::grid(20), 0.1)})
            CHECK(test::changes_that_matter(source, mesh) == std::vector<std::string>{});
    }
}

TEST_CASE("self_intersections: every option takes from the same pairs") {
    test::random source(5);
    const tf::mesh mesh = test::lattice_soup(source, 400, 300, 6);
    const pairs all = pairs_in(mesh);
    REQUIRE(all.size() > 1000);
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k) {
        tf::face_pair_options options;
        options.vertices = tf::vertex_identity::by_index;
        options.kinds = static_cast<tf::pair_kind>(k);
        CHECK(tf::self_intersections(mesh, options).pairs ==
              of_kind(static_cast<tf::pair_kind>(k), all));
    }
    const auto limited =
        tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index, .limit = 17});
    CHECK(limited.pairs == pairs(all.begin(), all.begin() + 17));
    CHECK(limited.counts ==
          tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).counts);

    std::vector<std::uint32_t> component(mesh.faces.size());
    for (std::uint32_t& c : component) c = static_cast<std::uint32_t>(source.below(3));
    pairs within;
    pairs between;
    for (const tf::face_pair& pair : all)
        (component[pair.a] == component[pair.b] ? within : between).push_back(pair);
    CHECK(tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index,
                                        .component_of_face = component,
                                        .within = true})
              .pairs == within);
    CHECK(tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index,
                                        .component_of_face = component,
                                        .between = true})
              .pairs == between);
}

TEST_CASE("self_intersections: the first pair is one of all, on any number of threads the same") {
    test::random source(6);
    const tf::mesh mesh = test::random_soup(source, 20000, 0.01);
    const pairs all = pairs_in(mesh);
    const pairs first = tf::self_intersections(
                            mesh, {.vertices = tf::vertex_identity::by_index, .first_only = true})
                            .pairs;
    REQUIRE(first.size() == 1);
    CHECK(std::find(all.begin(), all.end(), first[0]) != all.end());
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::self_intersections(
                  mesh, {.vertices = tf::vertex_identity::by_index, .first_only = true})
                  .pairs == first);
    }
    CHECK(tf::self_intersections(test::grid(30), {.first_only = true}).pairs.empty());
}

TEST_CASE("self_intersections: what cannot be meant is refused") {
    tf::mesh mesh = test::grid(2);
    const std::vector<std::uint32_t> short_list(3);
    CHECK_THROWS_AS((void)tf::self_intersections(mesh, {.component_of_face = short_list}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::self_intersections(mesh, {.within = true}), std::invalid_argument);
    mesh.faces[1][2] = 9;
    CHECK_THROWS_WITH_AS((void)tf::self_intersections(mesh),
                         doctest::Contains("face 1 has a corner out of range"),
                         std::invalid_argument);
    mesh.faces.clear();
    mesh.points[3].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)tf::self_intersections(mesh), doctest::Contains("point 3"),
                         std::invalid_argument);
}

TEST_CASE("self_intersections: a caller that says stop is heard, and told so") {
    test::random source(7);
    const tf::mesh mesh = test::random_soup(source, 20000, 0.01);
    double last = 0.0;
    bool grows = true;
    const auto whole = tf::self_intersections(mesh, {.progress = [&](double done) {
                                                  grows = grows && done >= last && done <= 1.0;
                                                  last = done;
                                                  return true;
                                              }});
    CHECK(grows);
    CHECK(last == 1.0);
    CHECK_FALSE(whole.status == tf::status::cancelled);
    CHECK(tf::self_intersections(mesh, {.progress = [](double) { return false; }}).status ==
          tf::status::cancelled);
}
