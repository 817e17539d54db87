/// \file
/// What becomes of properties when a mesh is welded: those that must agree, that choose the point
/// which is kept, and that follow their points and faces.

#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/columns.hpp>
#include <support/extremes.hpp>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::infinity;
using test::not_a_number;
using test::vertex_columns;
using ids = std::vector<std::uint32_t>;

std::vector<double> values_of(const tf::attributes& a, const char* element, const char* column) {
    const tf::column* c = a.find(element)->find(column);
    REQUIRE(c != nullptr);
    std::vector<double> values;
    for (std::size_t i = 0; i < c->size(); ++i) values.push_back(c->number(i));
    return values;
}

bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

TEST_CASE("weld: a property that must be equal keeps points apart, NaN being equal to NaN") {
    const tf::mesh cloud{std::vector<tf::point3>(8), {}};
    const auto properties = vertex_columns(
        {{"nx", {0.0, -0.0, not_a_number, not_a_number, infinity, infinity, 0.0, 1.0}},
         {"t", {1, 1, 2, 2, 3, 3, 1, 1}},
         {"blue", {1, 1, 1, 1, 1, 1, not_a_number, 1}}});
    const auto groups = [&](std::vector<tf::weld_condition> conditions) {
        return tf::weld(cloud, properties, {.same = std::move(conditions)}).groups.group_of_point;
    };
    const auto seams_of = [](const tf::attributes& of) {
        return tf::weld_options{.keep_seams = true}.conditions(of, true);
    };
    CHECK(groups({}) == ids(8, 0));
    CHECK(groups({{"nx"}}) == ids{0, 0, 1, 1, 2, 2, 0, 3});
    CHECK(groups({{"nx"}, {"t"}}) == ids{0, 0, 1, 1, 2, 2, 0, 3});
    CHECK(groups({{"nx"}, {"t"}, {"blue"}}) == ids{0, 0, 1, 1, 2, 2, 3, 4});
    CHECK(groups({{"nx", 1.0}}) == ids{0, 0, 1, 1, 2, 2, 0, 0});
    CHECK(groups(seams_of(properties)) == ids{0, 0, 1, 1, 2, 2, 3, 4});
    CHECK(seams_of(properties).size() == 3);
    CHECK(seams_of({}).empty());
}

TEST_CASE("weld: the tolerance of a property is inclusive to the last bit") {
    const tf::mesh cloud{std::vector<tf::point3>(2), {}};
    const auto joined = [&](double a, double b, double tolerance) {
        const auto properties = vertex_columns({{"quality", {a, b}}});
        return tf::weld(cloud, properties, {.same = {{"quality", tolerance}}}).mesh.points.size() ==
               1;
    };
    CHECK(joined(0.5, 0.75, 0.25));
    CHECK_FALSE(joined(0.5, 0.75, std::nextafter(0.25, 0.0)));
    // The difference is 1 + 2^-80 or 1 - 2^-80, rounded to 1 either way.
    CHECK_FALSE(joined(1.0, -0x1p-80, 1.0));
    CHECK(joined(1.0, 0x1p-80, 1.0));
    CHECK_FALSE(joined(-0x1p-80, 1.0, 1.0));
    CHECK(joined(0x1p-80, 1.0, 1.0));
    const double most = std::numeric_limits<double>::max();
    CHECK_FALSE(joined(-most, most, most));
    CHECK(joined(0, most, most));
    CHECK_FALSE(joined(infinity, most, most));
    CHECK_FALSE(joined(not_a_number, 0, most));
}

TEST_CASE("weld: whole numbers that no double holds are told apart") {
    const tf::mesh cloud{std::vector<tf::point3>(3), {}};
    constexpr std::int64_t large = std::int64_t{1} << 60;
    const std::vector<std::int64_t> time{large + 1, large, large + 3};
    const std::vector<std::uint64_t> id{~std::uint64_t{0}, ~std::uint64_t{0} - 1, 0};
    tf::attributes properties;
    properties.find_or_add("vertex", 3).columns = {tf::column::of<std::int64_t>("time", time),
                                                   tf::column::of<std::uint64_t>("id", id)};
    const auto groups = [&](const char* name, double tolerance) {
        return tf::weld(cloud, properties, {.same = {{name, tolerance}}}).groups.group_of_point;
    };
    CHECK(groups("time", 0.0) == ids{0, 1, 2});
    CHECK(groups("time", 1.75) == ids{0, 0, 1});
    CHECK(groups("time", 2.0) == ids{0, 0, 0});
    CHECK(groups("id", 0.0) == ids{0, 1, 2});
    CHECK(groups("id", 1.0) == ids{0, 0, 1});
    CHECK(groups("id", 0x1p63) == ids{0, 0, 1});
    CHECK(groups("id", 0x1p64) == ids{0, 0, 0});
    const auto kept = [&](tf::weld_keep keep, const char* by) {
        return tf::weld(cloud, properties, {.keep = keep, .keep_by = by}).vertex_source;
    };
    CHECK(kept(tf::weld_keep::lowest, "time") == ids{1});
    CHECK(kept(tf::weld_keep::highest, "time") == ids{2});
    CHECK(kept(tf::weld_keep::highest, "id") == ids{0});
    const std::vector<std::int64_t> below{-1, 0, std::numeric_limits<std::int64_t>::min()};
    properties.find_or_add("vertex", 3).columns[0] = tf::column::of<std::int64_t>("time", below);
    CHECK(kept(tf::weld_keep::lowest, "time") == ids{2});
    CHECK(groups("time", 1.0) == ids{0, 0, 1});
}

TEST_CASE("weld: conditions are those of the groups by definition") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh cloud = test::lattice_soup(source, 0, 120, 3);
        std::vector<std::vector<double>> columns(4, std::vector<double>(120));
        for (auto& c : columns)
            for (double& x : c)
                x = source.below(5) == 0 ? not_a_number : static_cast<double>(source.below(3));
        ids label(120);
        for (auto& k : label) k = static_cast<std::uint32_t>(source.below(2)) * 0xfffffffeU;
        const auto properties = vertex_columns(
            {{"a", columns[0]}, {"b", columns[1]}, {"c", columns[2]}, {"d", columns[3]}});
        const auto equal = [](double x, double y, double tolerance) {
            return (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= tolerance;
        };
        const auto odd = [](std::uint32_t i, std::uint32_t j) { return (i + j) % 7 != 3; };
        const tf::weld_options by_definition{
            .tolerance = 1.0, .label = label, .may_merge = [&](std::uint32_t i, std::uint32_t j) {
                return equal(columns[0][i], columns[0][j], 0.0) &&
                       equal(columns[1][i], columns[1][j], 0.0) &&
                       equal(columns[2][i], columns[2][j], 0.0) &&
                       equal(columns[3][i], columns[3][j], 1.0) && odd(i, j);
            }};
        const auto welded = tf::weld(cloud, properties,
                                     {.tolerance = 1.0,
                                      .label = label,
                                      .may_merge = odd,
                                      .same = {{"a", 0.0}, {"d", 1.0}, {"b", 0.0}, {"c", 0.0}}});
        CHECK(welded.groups.group_of_point ==
              tf::group_points(cloud.points, by_definition).group_of_point);
    }
}

TEST_CASE("weld: the point that is kept is the one asked for") {
    const tf::mesh cloud{{{0, 0, 3}, {0, 0, 5}, {0, 0, 2}, {0, 0, 2}, {9, 0, 0}}, {}};
    const auto properties = vertex_columns({{"q", {not_a_number, 7, 7, 1, not_a_number}}});
    const auto kept = [&](tf::weld_keep keep, const char* by = "") {
        const auto welded =
            tf::weld(cloud, properties, {.tolerance = 4.0, .keep = keep, .keep_by = by});
        CHECK(welded.groups.first_of_group == ids{0, 4});
        CHECK(welded.mesh.points[0] == cloud.points[welded.vertex_source[0]]);
        return welded.vertex_source;
    };
    CHECK(kept(tf::weld_keep::first) == ids{0, 4});
    CHECK(kept(tf::weld_keep::last) == ids{3, 4});
    CHECK(kept(tf::weld_keep::lowest, "z") == ids{2, 4});
    CHECK(kept(tf::weld_keep::highest, "z") == ids{1, 4});
    CHECK(kept(tf::weld_keep::lowest, "q") == ids{3, 4});
    CHECK(kept(tf::weld_keep::highest, "q") == ids{1, 4});
}

TEST_CASE("weld: means are of places and of floating-point columns") {
    const tf::mesh cloud{{{0, 0, 0}, {1, 0, 0}, {0, 4, 0}, {50, 0, 0}}, {}};
    auto properties = vertex_columns({{"q", {1, 2, 6, 0.1}}});
    tf::element& vertices = properties.elements[0];
    const std::vector<float> single{0.5F, 1.0F, 0.0F, 0.1F};
    const std::vector<std::uint8_t> whole{7, 8, 9, 10};
    vertices.columns.push_back(tf::column::of<float>("f", single));
    vertices.columns.push_back(tf::column::of<std::uint8_t>("red", whole));
    const auto welded =
        tf::weld(cloud, properties, {.tolerance = 4.0, .keep = tf::weld_keep::mean});
    CHECK(welded.groups.group_of_point == ids{0, 0, 0, 1});
    CHECK(welded.mesh.points[0].x == doctest::Approx(1.0 / 3.0).epsilon(1e-15));
    CHECK(welded.mesh.points[0].y == doctest::Approx(4.0 / 3.0).epsilon(1e-15));
    CHECK(welded.mesh.points[1] == cloud.points[3]);
    CHECK(same_values(values_of(welded.attributes, "vertex", "q"), {3.0, 0.1}));
    CHECK(
        same_values(values_of(welded.attributes, "vertex", "f"), {0.5, static_cast<double>(0.1F)}));
    CHECK(same_values(values_of(welded.attributes, "vertex", "red"), {7.0, 10.0}));
}

TEST_CASE("weld: a mean stays among its values, however large, small or many") {
    const double most = std::numeric_limits<double>::max();
    const auto mean = [](const std::vector<double>& values) {
        const tf::mesh cloud{std::vector<tf::point3>(values.size()), {}};
        const auto welded =
            tf::weld(cloud, vertex_columns({{"q", values}}), {.keep = tf::weld_keep::mean});
        return values_of(welded.attributes, "vertex", "q").at(0);
    };
    CHECK(mean(std::vector<double>(1000, 0.1)) == 0.1);
    CHECK(mean({most, most, most}) == most);
    CHECK(mean({-most, most}) == 0.0);
    CHECK(mean({-most, most, most, -most, most / 2, most / 2, 0, 0}) ==
          doctest::Approx(most / 8).epsilon(1e-15));
    CHECK(mean({5e-324, 5e-324}) == 5e-324);
    CHECK(std::isnan(mean({1.0, not_a_number})));
    CHECK(std::isnan(mean({1.0, infinity})));
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        test::random source(seed);
        std::vector<double> values(3 + source.below(40));
        long double sum = 0;
        for (double& x : values) sum += x = source.in(1.0, 1.5);
        const auto exact = static_cast<double>(sum / static_cast<long double>(values.size()));
        CHECK(std::abs(mean(values) - exact) <= static_cast<double>(values.size()) * 0x1p-53);
    }
}

TEST_CASE("weld: rows of vertices, faces and edges follow, parts keep their faces") {
    const tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        {{1, 2, 0}, {0, 1, 3}, {0, 2, 4}, {2, 1, 3}, {3, 2, 4}}};
    tf::attributes properties = vertex_columns({{"q", {10, 11, 12, 13, 14}}});
    tf::element& faces = properties.find_or_add("face", 5);
    const std::vector<std::int16_t> material{0, 1, 2, 3, 4};
    faces.columns.push_back(tf::column::of<std::int16_t>("material", material));
    tf::column wedge{
        .name = "texcoord", .type = tf::scalar_type::uint8, .list_length = tf::scalar_type::uint8};
    wedge.list_begin = {0, 1, 1, 3, 4, 6};
    for (std::uint8_t i = 0; i < 6; ++i) wedge.values.push_back(std::byte{i});
    faces.columns.push_back(wedge);
    tf::element& edges = properties.find_or_add("edge", 3);
    const std::vector<std::int32_t> ends[] = {{0, 1, -1}, {2, 4, 77}};
    edges.columns.push_back(tf::column::of<std::int32_t>("vertex1", ends[0]));
    edges.columns.push_back(tf::column::of<std::int32_t>("vertex2", ends[1]));
    properties.parts = {{.object = "a"},
                        {.object = "b", .first_face = 1},
                        {.object = "c", .first_face = 3},
                        {.object = "d", .first_face = 4}};
    properties.comments = {"kept"};

    const auto welded = tf::weld(mesh, properties, {.keep = tf::weld_keep::last});
    CHECK(welded.face_source == ids{1, 2, 4});
    const tf::attributes& now = welded.attributes;
    CHECK(same_values(values_of(now, "vertex", "q"), {10, 12, 13, 14}));
    CHECK(same_values(values_of(now, "face", "material"), {1, 2, 4}));
    CHECK(same_values(values_of(now, "face", "texcoord"), {1, 2, 4, 5}));
    CHECK(same_values(values_of(now, "edge", "vertex1"), {0, 1, -1}));
    CHECK(same_values(values_of(now, "edge", "vertex2"), {1, 3, 77}));
    CHECK(now.comments == properties.comments);
    ids first_faces;
    for (const tf::named_faces& p : now.parts) first_faces.push_back(p.first_face);
    CHECK(first_faces == ids{0, 0, 2, 2});
}

TEST_CASE(
    "weld: corners of faces that stay keep what they have, and what does not fit is refused") {
    const tf::mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                        {{1, 2, 0}, {0, 1, 3}, {2, 3, 0}}};
    constexpr std::uint32_t none = tf::corner_values::none;
    tf::attributes properties{
        .corners = {.texture = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                    .normals = {{0, 0, 1}},
                    .texture_of_corner = {{0, 0, 0}, {0, 1, 2}, {2, none, 1}},
                    .normal_of_corner = {{0, 0, 0}, {none, 0, 0}, {0, 0, none}}},
        .material_files = {"a.mtl"},
        .texture_files = {"a.png"}};
    const auto welded = tf::weld(mesh, properties, {});
    CHECK(welded.face_source == ids{1, 2});
    tf::attributes expected = properties;
    expected.corners.texture_of_corner = {{0, 1, 2}, {2, none, 1}};
    expected.corners.normal_of_corner = {{none, 0, 0}, {0, 0, none}};
    CHECK(welded.attributes == expected);

    tf::attributes bad = properties;
    bad.corners.texture_of_corner[2][0] = 3;
    CHECK_THROWS_AS(static_cast<void>(tf::weld(mesh, bad, {})), std::invalid_argument);
    bad = properties;
    bad.corners.normal_of_corner.pop_back();
    CHECK_THROWS_AS(static_cast<void>(tf::weld(mesh, bad, {})), std::invalid_argument);
}
