#include <libmesh/boolean/split_nonmanifold.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;
using tf::detail::boolean::manifold_surface;
using tf::detail::boolean::split_nonmanifold;

tf::mesh union_of(const std::vector<tf::mesh>& meshes) {
    const tf::boolean_result made =
        tf::boolean(std::vector<tf::mesh_view>(meshes.begin(), meshes.end()),
                    tf::boolean_expression::union_of(meshes.size()));
    REQUIRE(made.certificate);
    return tf::join_equal_points(made.mesh);  // as it was before it became a manifold
}

/// After a look at whether it is the same surface.
manifold_surface separated(const tf::mesh& solid) {
    const manifold_surface result = split_nonmanifold(tf::mesh(solid));
    const tf::mesh& now = result.surface;
    CHECK(now.points.size() == solid.points.size() + result.vertex_of_added.size());
    CHECK(now.faces.size() == solid.faces.size());
    for (std::size_t f = 0; f < now.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = now.faces[f][i];
            const bool is_added = v >= solid.points.size();
            CHECK((is_added ? result.vertex_of_added[v - solid.points.size()] : v) ==
                  solid.faces[f][i]);
            CHECK(now.points[now.faces[f][i]] == solid.points[solid.faces[f][i]]);
        }
    const auto topology = tf::count_topology(now.points.size(), now.faces);
    CHECK(topology.boundary_edges == 0);
    CHECK(topology.misoriented_edges == 0);
    CHECK(topology.nonmanifold_points == 0);
    CHECK(topology.nonmanifold_edges == result.shared_edges);
    return result;
}

/// The unit cubes of a 3 x 3 x 3 lattice that `bits` names.
tf::mesh cubes_of(std::uint32_t bits) {
    std::vector<tf::mesh> cubes;
    for (std::uint32_t i = 0; i < 27; ++i)
        if ((bits >> i & 1U) != 0)
            cubes.push_back(
                moved(box(1, 1, 1), {static_cast<double>(i % 3), static_cast<double>(i / 3 % 3),
                                     static_cast<double>(i / 9)}));
    return union_of(cubes);
}

constexpr std::uint32_t cube_at(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return 1U << (x + 3 * y + 9 * z);
}

}  // namespace

TEST_CASE("split_nonmanifold: a manifold stays as it is") {
    CHECK(separated({}).surface == tf::mesh{});
    for (const tf::mesh& solid : {box(1, 2, 3), test::ball(2, 1.0)}) {
        const manifold_surface result = separated(solid);
        CHECK(result.surface == solid);
        CHECK(result.vertex_of_added.size() == 0);
    }
}

TEST_CASE("split_nonmanifold: boxes that touch in a corner or an edge come apart") {
    const manifold_surface corner =
        separated(union_of({box(1, 1, 1), moved(box(1, 1, 1), {1, 1, 1})}));
    CHECK(corner.vertex_of_added.size() == 1);
    const manifold_surface edge =
        separated(union_of({box(1, 1, 1), moved(box(1, 1, 1), {1, 1, 0})}));
    CHECK(edge.vertex_of_added.size() == 2);
    CHECK(edge.shared_edges == 0);
    const auto topology = tf::count_topology(edge.surface.points.size(), edge.surface.faces);
    CHECK(topology.closed_manifold);
    CHECK(topology.components_by_point == 2);
    // Along a part of an edge: only the corners that are in it.
    CHECK(separated(union_of({box(1, 1, 4), moved(box(1, 1, 2), {1, 1, 1})}))
              .vertex_of_added.size() == 2);
}

TEST_CASE("split_nonmanifold: hollow spaces that touch within a solid come apart") {
    const tf::mesh block = box(4, 3, 3);
    const std::vector<tf::mesh> hollow{moved(box(1, 1, 1), {1, 1, 1}),
                                       moved(box(1, 0.5, 0.5), {2, 1.5, 0.5})};
    std::vector<tf::mesh_view> views{block};
    views.insert(views.end(), hollow.begin(), hollow.end());
    const tf::boolean_result made = tf::boolean(views, tf::boolean_expression::difference_of(3));
    REQUIRE(made.certificate);
    CHECK(separated(tf::join_equal_points(made.mesh)).shared_edges == 0);
}

TEST_CASE(
    "split_nonmanifold: an edge whose ends are held together above and below goes the other way") {
    // Two cubes that touch in an edge, with a whole layer above them and one below: the solid's
    // wedges are linked at both ends, space's are not.
    std::uint32_t bits = cube_at(0, 0, 1) | cube_at(1, 1, 1);
    for (const std::uint32_t z : {0U, 2U})
        for (const std::uint32_t x : {0U, 1U})
            for (const std::uint32_t y : {0U, 1U}) bits |= cube_at(x, y, z);
    const manifold_surface result = separated(cubes_of(bits));
    CHECK(result.shared_edges == 0);
    CHECK(result.vertex_of_added.size() == 2);
}

TEST_CASE("split_nonmanifold: any heap of cubes, touching as they may, becomes a manifold") {
    test::random source(41);
    for (int round = 0; round < 60; ++round) {
        CAPTURE(round);
        const auto bits = static_cast<std::uint32_t>(source.below(std::size_t{1} << 27));
        const tf::mesh heap = cubes_of(bits);
        const manifold_surface result = separated(heap);
        CHECK(result.shared_edges <= 2);
        CHECK(tf::signed_volume(result.surface) == tf::signed_volume(heap));
        CHECK(tf::join_equal_points(result.surface).points.size() == heap.points.size());
    }
}

TEST_CASE("split_nonmanifold: the same on any number of threads") {
    const tf::mesh heap = cubes_of(0x5a3c96b);
    const manifold_surface expected = split_nonmanifold(tf::mesh(heap));
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(split_nonmanifold(tf::mesh(heap)).surface == expected.surface);
    }
}
