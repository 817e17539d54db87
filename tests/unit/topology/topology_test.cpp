#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using faces = std::vector<tf::face>;
using ids = std::vector<std::uint32_t>;

const faces tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

bool three_corners(const tf::face& f) { return std::set(f.begin(), f.end()).size() == 3; }

/// Groups of 0 ... count-1 under `linked`, by flooding.
std::size_t groups(std::size_t count, const std::function<bool(std::size_t, std::size_t)>& linked) {
    std::vector<bool> seen(count, false);
    std::size_t found = 0;
    for (std::size_t start = 0; start < count; ++start) {
        if (seen[start]) continue;
        ++found;
        std::vector<std::size_t> open{start};
        seen[start] = true;
        while (!open.empty()) {
            const std::size_t at = open.back();
            open.pop_back();
            for (std::size_t next = 0; next < count; ++next)
                if (!seen[next] && linked(at, next)) {
                    seen[next] = true;
                    open.push_back(next);
                }
        }
    }
    return found;
}

std::vector<std::uint32_t> common(tf::face a, tf::face b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<std::uint32_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
}

void count_edges(const faces& list, tf::topology_counts& c) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> uses;
    for (const tf::face& f : list)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(f[k], f[(k + 1) % 3]);
            ++uses[{low, high}][low == f[k] ? 0 : 1];
        }
    c.edges = uses.size();
    for (const auto& [edge, n] : uses) {
        c.boundary_edges += n[0] + n[1] == 1 ? 1 : 0;
        c.nonmanifold_edges += n[0] + n[1] >= 3 ? 1 : 0;
        c.misoriented_edges += n[0] + n[1] == 2 && n[0] != 1 ? 1 : 0;
    }
}

/// The words of the header, one loop each.
tf::topology_counts by_definition(const faces& given) {
    tf::topology_counts c;
    faces list;
    std::copy_if(given.begin(), given.end(), std::back_inserter(list), three_corners);
    c.faces = list.size();
    c.repeated_corner_faces = given.size() - list.size();
    count_edges(list, c);
    std::set<std::set<std::uint32_t>> triples;
    std::map<std::uint32_t, faces> at;
    for (const tf::face& f : list) {
        triples.insert({f.begin(), f.end()});
        for (const std::uint32_t corner : f) at[corner].push_back(f);
    }
    c.duplicate_faces = list.size() - triples.size();
    c.points_used = at.size();
    for (const auto& [point, star] : at) {
        const auto linked = [&, &s = star](std::size_t i, std::size_t j) {
            return common(s[i], s[j]).size() >= 2;  // the point itself, and the edge's other end
        };
        c.nonmanifold_points += groups(star.size(), linked) > 1 ? 1 : 0;
    }
    c.components_by_point = groups(list.size(), [&](std::size_t i, std::size_t j) {
        return !common(list[i], list[j]).empty();
    });
    c.components_by_edge = groups(list.size(), [&](std::size_t i, std::size_t j) {
        return common(list[i], list[j]).size() >= 2;
    });
    c.closed_manifold = !list.empty() && c.boundary_edges == 0 && c.nonmanifold_edges == 0;
    return c;
}

void check_equal(const tf::topology_counts& a, const tf::topology_counts& b) {
    CHECK(a.edges == b.edges);
    CHECK(a.boundary_edges == b.boundary_edges);
    CHECK(a.nonmanifold_edges == b.nonmanifold_edges);
    CHECK(a.misoriented_edges == b.misoriented_edges);
    CHECK(a.nonmanifold_points == b.nonmanifold_points);
    CHECK(a.components_by_point == b.components_by_point);
    CHECK(a.components_by_edge == b.components_by_edge);
    CHECK(a.points_used == b.points_used);
    CHECK(a.faces == b.faces);
    CHECK(a.repeated_corner_faces == b.repeated_corner_faces);
    CHECK(a.duplicate_faces == b.duplicate_faces);
    CHECK(a.closed_manifold == b.closed_manifold);
}

tf::topology_counts check(std::size_t point_count, const faces& list) {
    const tf::topology_counts found = tf::count_topology(point_count, list);
    check_equal(found, by_definition(list));
    return found;
}

}  // namespace

TEST_CASE("topology: nothing is not closed") {
    CHECK_FALSE(check(0, {}).closed_manifold);
    CHECK_FALSE(check(5, {}).closed_manifold);
    const auto repeated = check(3, {{1, 1, 2}, {0, 0, 0}});
    CHECK(repeated.repeated_corner_faces == 2);
    CHECK(repeated.edges == 0);
    CHECK(repeated.points_used == 0);
    CHECK_FALSE(repeated.closed_manifold);
}

TEST_CASE("topology: a tetrahedron is closed until a face goes, turns or comes twice") {
    auto c = check(4, tetrahedron);
    CHECK(c.closed_manifold);
    CHECK(c.points_used - c.edges + c.faces == 2);
    CHECK(c.misoriented_edges == 0);

    c = check(4, {tetrahedron[0], tetrahedron[1], tetrahedron[2]});
    CHECK_FALSE(c.closed_manifold);
    CHECK(c.boundary_edges == 3);

    faces turned = tetrahedron;
    std::swap(turned[0][0], turned[0][1]);
    c = check(4, turned);
    CHECK(c.closed_manifold);
    CHECK(c.misoriented_edges == 3);

    faces twice = tetrahedron;
    twice.push_back({1, 0, 2});
    twice.push_back({2, 1, 0});
    c = check(4, twice);
    CHECK_FALSE(c.closed_manifold);
    CHECK(c.nonmanifold_edges == 3);
    CHECK(c.duplicate_faces == 2);
}

TEST_CASE("topology: two tetrahedra at a point are one component by points and two by edges") {
    faces two = tetrahedron;
    for (const tf::face& f : tetrahedron) {
        tf::face other = f;
        for (std::uint32_t& corner : other) corner = corner == 0 ? 0 : corner + 10;
        two.push_back(other);
    }
    const auto c = check(14, two);
    CHECK(c.closed_manifold);
    CHECK(c.nonmanifold_points == 1);
    CHECK(c.components_by_point == 1);
    CHECK(c.components_by_edge == 2);
    CHECK(tf::face_components(14, two) == ids(8, 0));
}

TEST_CASE("topology: faces at a nonmanifold edge are one fan") {
    const auto c = check(5, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
    CHECK(c.nonmanifold_edges == 1);
    CHECK(c.nonmanifold_points == 0);
    CHECK(c.components_by_edge == 1);
}

TEST_CASE("topology: a Moebius strip is misoriented somewhere whatever the first face is") {
    faces strip;
    for (std::uint32_t i = 0; i < 5; ++i) strip.push_back({i, (i + 1) % 5, (i + 2) % 5});
    const auto c = check(5, strip);
    CHECK(c.boundary_edges == 5);
    CHECK(c.misoriented_edges == 5);
    CHECK(c.points_used + c.faces == c.edges);
}

TEST_CASE("topology: as its definition on random faces, many of them alike") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 10 + seed, 4 + seed * 7 % 60, 2);
        check(soup.points.size(), soup.faces);
    }
}

TEST_CASE("topology: a sheet of any size, its points and faces in any order, on any threads") {
    constexpr std::uint32_t side = 150;
    test::random source(1);
    const tf::mesh sheet = test::grid(side);
    const tf::mesh other = test::shuffled(source, sheet).mesh;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto c = tf::count_topology(other.points.size(), other.faces);
        CHECK(c.edges == 3 * side * side + 2 * side);
        CHECK(c.boundary_edges == 4 * side);
        CHECK(c.components_by_edge == 1);
        CHECK(c.components_by_point == 1);
        CHECK(c.nonmanifold_points + c.nonmanifold_edges + c.misoriented_edges == 0);
        check_equal(c, tf::count_topology(sheet.points.size(), sheet.faces));
    }
}

TEST_CASE("topology: a hundred thousand faces at one point are counted in no time that squares") {
    constexpr std::uint32_t count = 100000;
    faces wheel;
    for (std::uint32_t i = 0; i < count; ++i) wheel.push_back({0, 1 + i, 1 + (i + 1) % count});
    const auto c = tf::count_topology(count + 1, wheel);
    CHECK(c.edges == 2 * count);
    CHECK(c.boundary_edges == count);
    CHECK(c.nonmanifold_points == 0);
    faces star;
    for (std::uint32_t i = 0; i < count; ++i) star.push_back({0, 2 * i + 1, 2 * i + 2});
    const auto loose = tf::count_topology(2 * count + 1, star);
    CHECK(loose.nonmanifold_points == 1);
    CHECK(loose.components_by_edge == count);
    CHECK(loose.components_by_point == 1);
    const auto copies = tf::count_topology(3, faces(count, {2, 0, 1}));
    CHECK(copies.duplicate_faces == count - 1);
    CHECK(copies.nonmanifold_edges == 3);
}

TEST_CASE("face_components: numbered by their lowest face, faces that repeat a corner included") {
    CHECK(tf::face_components(0, {}).empty());
    CHECK(tf::face_components(10, faces{{7, 8, 9}, {0, 1, 2}, {9, 9, 3}, {4, 4, 4}, {2, 5, 5}}) ==
          ids{0, 1, 0, 2, 1});
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 60, 100, 2);
        const ids found = tf::face_components(soup.points.size(), soup.faces);
        const std::size_t expected = groups(60, [&](std::size_t i, std::size_t j) {
            return !common(soup.faces[i], soup.faces[j]).empty();
        });
        std::uint32_t next = 0;
        for (std::size_t i = 0; i < 60; ++i) {
            REQUIRE(found[i] <= next);
            next += found[i] == next ? 1 : 0;
            for (std::size_t j = 0; j < i; ++j)
                if (!common(soup.faces[i], soup.faces[j]).empty()) REQUIRE(found[i] == found[j]);
        }
        CHECK(next == expected);
    }
}

TEST_CASE("topology: a corner out of range is refused by the number of its face") {
    const faces list{{0, 1, 2}, {1, 2, 3}};
    CHECK_NOTHROW((void)tf::count_topology(4, list));
    CHECK_THROWS_WITH_AS(
        (void)tf::count_topology(3, list),
        doctest::Contains("treeform::count_topology: face 1 has a corner out of range"),
        std::invalid_argument);
    CHECK_THROWS_AS((void)tf::face_components(3, list), std::invalid_argument);
}
