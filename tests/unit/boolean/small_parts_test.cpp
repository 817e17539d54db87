#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;

tf::boolean_result without_small(const std::vector<tf::mesh>& meshes, const char* formula,
                                 double min_volume) {
    const std::vector<tf::mesh_view> views(meshes.begin(), meshes.end());
    const tf::boolean_result result =
        tf::boolean(views, {formula, views.size()}, {.min_volume = min_volume});
    REQUIRE(result.certificate);
    CHECK(test::is_clean_solid(result.mesh));
    REQUIRE(result.face_source.size() == result.mesh.faces.size());
    REQUIRE(result.vertex_source.size() == result.mesh.points.size());
    for (std::size_t p = 0; p < result.mesh.points.size(); ++p)
        if (const auto& [operand, index] = result.vertex_source[p];
            operand != tf::operand_element::none)
            CHECK(result.mesh.points[p] == meshes[operand].points[index]);
    if (!result.face_of_cut_vertex.empty())
        CHECK(result.face_of_cut_vertex.size() == result.mesh.points.size());
    return result;
}

}  // namespace

TEST_CASE("small parts: a part goes when its volume is below, and stays when it is equal") {
    const std::vector<tf::mesh> two{moved(box(0.5, 0.5, 0.5), {5, 0, 0}), box(1, 1, 1)};
    CHECK(without_small(two, "a+b", 0.125).mesh.faces.size() == 24);
    const tf::boolean_result less = without_small(two, "a+b", 0.1250001);
    CHECK(tf::signed_volume(less.mesh) == 1.0);
    CHECK(less.mesh.points.size() == 8);
    CHECK(less.face_source.front().operand == 1);
    CHECK(less.statistics.small_parts == 1);
    CHECK(less.statistics.small_volume == 0.125);
}

TEST_CASE("small parts: a void is filled with what is in it, an island goes with its own voids") {
    const std::vector<tf::mesh> nested{box(4, 4, 4), moved(box(2, 2, 2), {1, 1, 1}),
                                       moved(box(1, 1, 1), {1.5, 1.5, 1.5}),
                                       moved(box(0.5, 0.5, 0.5), {1.75, 1.75, 1.75})};
    const auto volume = [&](double least) {
        return tf::signed_volume(without_small(nested, "a-b+c-d", least).mesh);
    };
    CHECK(volume(0.0) == 64 - 8 + 1 - 0.125);
    CHECK(volume(0.5) == 64 - 8 + 1);
    CHECK(volume(2.0) == 64 - 8);
    CHECK(volume(9.0) == 64);
    const tf::boolean_result none = without_small(nested, "a-b+c-d", 65.0);
    CHECK(none.mesh.points.empty());
    CHECK(none.statistics.small_parts == 4);
    CHECK(none.statistics.small_volume == 64 + 8 + 1 + 0.125);
}

TEST_CASE("small parts: what touches at an edge is a part of its own, what cuts have made counts") {
    const std::vector<tf::mesh> touching{box(2, 2, 2), moved(box(1, 1, 2), {2, 2, 0})};
    CHECK(tf::signed_volume(without_small(touching, "a+b", 4.0).mesh) == 8.0);
    // A plate that does not quite reach through leaves two pieces of a bar and a thin one between.
    const std::vector<tf::mesh> cut{box(4, 1, 1), moved(box(1, 3, 3), {1, -1, -1}),
                                    moved(box(0.25, 3, 3), {2.25, -1, -1})};
    const tf::boolean_result pieces = without_small(cut, "a-b-c", 0.5);
    CHECK(tf::signed_volume(pieces.mesh) == 1.0 + 1.5);
    CHECK(pieces.statistics.small_parts == 1);
}

TEST_CASE("small parts: of solids only, and no volume that is none") {
    const std::vector<tf::mesh> two{box(1, 1, 1), moved(box(1, 1, 1), {0.5, 0, 0})};
    const std::vector<tf::mesh_view> views(two.begin(), two.end());
    const auto with = [&](double least) { return tf::boolean_options{.min_volume = least}; };
    CHECK_THROWS_AS(static_cast<void>(tf::split(views, with(1.0))), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::clip(views, 0, {"a-b", 2}, with(1.0))),
                    std::invalid_argument);
    for (const double bad :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(static_cast<void>(tf::unite(two[0], two[1], with(bad))),
                        std::invalid_argument);
}
