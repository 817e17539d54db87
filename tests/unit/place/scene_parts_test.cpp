#include <libmesh/attributes/scene_parts.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using numbers = std::vector<std::uint32_t>;

/// Triangles side by side along x, with no point in common.
tf::mesh row(std::uint32_t count) {
    tf::mesh m;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = 2.0 * i;
        m.points.insert(m.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        m.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return m;
}

tf::named_faces part(const char* object, const char* group, std::uint32_t first,
                     const char* material = "") {
    return {.object = object, .group = group, .material = material, .first_face = first};
}

std::vector<std::string> names_of(const std::vector<tf::scene_part>& parts) {
    std::vector<std::string> names;
    for (const tf::scene_part& p : parts) names.push_back(p.name);
    return names;
}

}  // namespace

TEST_CASE("scene_parts: no face is no part, and without names all are one") {
    CHECK(tf::scene_parts({}, {}).empty());
    const auto all = tf::scene_parts(row(3), {});
    REQUIRE(all.size() == 1);
    CHECK(all[0].name.empty());
    CHECK(all[0].faces == numbers{0, 1, 2});
    CHECK(all[0].box == tf::box3{{0, 0, 0}, {5, 1, 0}});
}

TEST_CASE("scene_parts: faces of one object and group are one part wherever they are") {
    const std::vector<tf::named_faces> names{part("a", "", 1), part("b", "left", 2),
                                             part("a", "", 3, "red"), part("b", "right", 4)};
    const auto parts = tf::scene_parts(row(6), names);
    CHECK(names_of(parts) == std::vector<std::string>{"", "a", "b/left", "b/right"});
    CHECK(parts[0].faces == numbers{0});
    CHECK(parts[1].faces == numbers{1, 3});
    CHECK(parts[2].faces == numbers{2});
    CHECK(parts[3].faces == numbers{4, 5});
    CHECK(parts[1].box == tf::box3{{2, 0, 0}, {7, 1, 0}});
}

TEST_CASE("scene_parts: parts with a point in common are one, by the name of the first") {
    tf::mesh m = row(4);
    m.faces[3][0] = m.faces[1][2];
    const std::vector<tf::named_faces> names{part("a", "", 0), part("b", "", 1), part("c", "", 2),
                                             part("d", "", 3)};
    const auto parts = tf::scene_parts(m, names);
    CHECK(names_of(parts) == std::vector<std::string>{"a", "b", "c"});
    CHECK(parts[1].faces == numbers{1, 3});
}

TEST_CASE("scene_parts: names go by the numbers that faces have in the file") {
    const std::vector<tf::named_faces> names{part("a", "", 0), part("b", "", 5)};
    const numbers number{1, 4, 4, 5, 9};
    const auto parts = tf::scene_parts(row(5), names, number);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].faces == numbers{0, 1, 2});
    CHECK(parts[1].faces == numbers{3, 4});
}

TEST_CASE("scene_parts: a name that no face has is no part") {
    const std::vector<tf::named_faces> names{part("a", "", 0), part("b", "", 1), part("c", "", 1),
                                             part("d", "", 7)};
    CHECK(names_of(tf::scene_parts(row(2), names)) == std::vector<std::string>{"a", "c"});
}

TEST_CASE("scene_parts: numbers of another count and corners that are no point are refused") {
    tf::mesh m = row(2);
    CHECK_THROWS_AS((void)tf::scene_parts(m, {}, numbers{1}), std::invalid_argument);
    m.faces[1][1] = 6;
    CHECK_THROWS_WITH_AS((void)tf::scene_parts(m, {}), doctest::Contains("face 1"),
                         std::invalid_argument);
}
