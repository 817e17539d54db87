#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

namespace {

using ids = std::vector<std::uint32_t>;
using pairs = std::vector<tf::face_pair>;

/// Sets of faces that grow until no two have a link, in the order of their lowest face.
std::vector<ids> by_definition(const tf::mesh& mesh, const pairs& list) {
    std::vector<std::set<std::uint32_t>> sets;
    for (const tf::face_pair& pair : list) sets.push_back({pair.a, pair.b});
    const auto corners = [&](const std::set<std::uint32_t>& faces) {
        std::set<std::uint32_t> all;
        for (const std::uint32_t f : faces) all.insert(mesh.faces[f].begin(), mesh.faces[f].end());
        return all;
    };
    const auto meet = [](const std::set<std::uint32_t>& a, const std::set<std::uint32_t>& b) {
        return std::any_of(a.begin(), a.end(), [&](std::uint32_t x) { return b.contains(x); });
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < sets.size(); ++i)
            for (std::size_t j = sets.size() - 1; j > i; --j)
                if (meet(corners(sets[i]), corners(sets[j]))) {
                    sets[i].merge(sets[j]);
                    sets.erase(sets.begin() + static_cast<std::ptrdiff_t>(j));
                    changed = true;
                }
    }
    std::vector<ids> result;
    for (const auto& s : sets) result.emplace_back(s.begin(), s.end());
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

TEST_CASE("regions: no pairs, no regions") {
    CHECK(tf::group_pairs({}, {}).empty());
    CHECK(tf::group_pairs(test::grid(3), {}).empty());
}

TEST_CASE("regions: pairs are linked by faces and by corners, not by faces that are in no pair") {
    // Faces 0 and 1 far apart, 2 shares a corner with 1, 3 links 2 to 4 but is in no pair.
    tf::mesh mesh;
    for (std::uint32_t i = 0; i < 20; ++i)
        mesh.points.push_back({static_cast<double>(i), -static_cast<double>(i), 0.5});
    mesh.faces = {{0, 1, 2}, {3, 4, 5}, {5, 6, 7}, {7, 8, 9}, {9, 10, 11}, {12, 13, 14}};
    const auto two = tf::group_pairs(mesh, pairs{{4, 5, {}}, {0, 1, {}}});
    REQUIRE(two.size() == 2);
    CHECK(two[0].faces == ids{0, 1});
    CHECK(two[0].min == tf::point3{0, -5, 0.5});
    CHECK(two[0].max == tf::point3{5, 0, 0.5});
    CHECK(two[1].faces == ids{4, 5});
    CHECK(two[0].pairs == ids{1});
    CHECK(two[1].pairs == ids{0});

    const auto by_corner = tf::group_pairs(mesh, pairs{{0, 1, {}}, {2, 5, {}}, {0, 5, {}}});
    REQUIRE(by_corner.size() == 1);
    CHECK(by_corner[0].faces == ids{0, 1, 2, 5});
    CHECK(by_corner[0].pairs == ids{0, 1, 2});
    CHECK(tf::group_pairs(mesh, pairs{{0, 2, {}}, {4, 5, {}}}).size() == 2);
    CHECK(tf::group_pairs(mesh, pairs{{0, 2, {}}, {3, 5, {}}}).size() == 1);
}

TEST_CASE("regions: as their definition on random pairs") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::lattice_soup(source, 200, 500, 9);
        pairs list(10 + seed);
        for (tf::face_pair& pair : list)
            pair = {static_cast<std::uint32_t>(source.below(200)),
                    static_cast<std::uint32_t>(source.below(200)), tf::pair_kind::touching};
        const auto found = tf::group_pairs(soup, list);
        const std::vector<ids> expected = by_definition(soup, list);
        REQUIRE(found.size() == expected.size());
        std::size_t grouped = 0;
        for (std::size_t r = 0; r < expected.size(); ++r) {
            const ids& faces = expected[r];
            CHECK(found[r].faces == faces);
            CHECK(std::is_sorted(found[r].pairs.begin(), found[r].pairs.end()));
            for (const std::uint32_t i : found[r].pairs)
                CHECK(std::binary_search(faces.begin(), faces.end(), list[i].a));
            grouped += found[r].pairs.size();
        }
        CHECK(grouped == list.size());  // regions have no face in common, so each pair is in one
    }
}

TEST_CASE("regions: two places where sheets cross are two, each with its box") {
    const tf::mesh sheet = test::grid(3);
    const tf::mesh blade{{{1.4, 1.3, -1}, {1.6, 1.3, -1}, {1.5, 1.3, 1}}, {{0, 1, 2}}};
    tf::mesh mesh = test::together(sheet, test::moved(sheet, {100, 0, 0}));
    mesh = test::together(mesh, test::together(blade, test::moved(blade, {100, 0, 0})));
    const pairs found = tf::self_intersections(mesh).pairs;
    const auto result = tf::group_pairs(mesh, found);
    REQUIRE(result.size() == 2);
    CHECK(result[0].max.x < 4);
    CHECK(result[1].min.x > 99);
    CHECK(result[0].min.z == -1);
    CHECK(result[0].pairs.size() + result[1].pairs.size() == found.size());
}

TEST_CASE("regions: a pair of a face that is not there is refused by its number") {
    const tf::mesh sheet = test::grid(1);
    CHECK_THROWS_WITH_AS((void)tf::group_pairs(sheet, pairs{{0, 1, {}}, {0, 2, {}}}),
                         "treeform::group_pairs: pair 1 has a face that is not in the mesh",
                         std::invalid_argument);
    tf::mesh bad = sheet;
    bad.faces[1][1] = 4;
    CHECK_THROWS_AS((void)tf::group_pairs(bad, pairs{{0, 0, {}}}), std::invalid_argument);
}
