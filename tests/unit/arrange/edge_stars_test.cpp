#include <libmesh/arrange/edge_stars.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using stars = std::vector<std::vector<std::uint32_t>>;

/// The words of the header, face by face.
stars by_definition(const tf::mesh& mesh) {
    stars result(mesh.points.size());
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        const auto& [a, b, c] = mesh.faces[i];
        if (a == b || b == c || c == a) continue;
        for (const std::uint32_t p : mesh.faces[i])
            if (p != std::max({a, b, c})) result[p].push_back(i);
    }
    return result;
}

void check(const tf::mesh& mesh) {
    const stars expected = by_definition(mesh);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::detail::arrange::edge_stars found(mesh.points.size(), mesh.faces);
        REQUIRE(found.size() == expected.size());
        bool same = true;
        for (std::size_t p = 0; p < expected.size(); ++p)
            same = same && std::ranges::equal(found[p], expected[p]);
        CHECK(same);
    }
}

}  // namespace

TEST_CASE("edge_stars: no faces, no points") {
    check({});
    check({{{0, 0, 0}, {1, 0, 0}}, {}});
    CHECK(tf::detail::arrange::edge_stars(0, {}).size() == 0);
}

TEST_CASE("edge_stars: each point has the faces of which it is not the highest corner, ascending") {
    check({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{2, 0, 1}, {0, 2, 2}, {1, 2, 0}}});
    check(test::grid(3));
    check(test::grid(200));  // several slices
    for (const std::size_t faces : {10U, 1000U, 70000U}) {
        CAPTURE(faces);
        test::random source(faces);
        check(test::lattice_soup(source, faces, 20, 3));  // faces with repeated corners, too
        check(test::lattice_soup(source, faces, 5000, 3));
    }
}
