#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_checks.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::inside_out;
using test::moved;
using test::prism;
using test::turned;

tf::boolean_result filled(const std::vector<tf::mesh>& meshes, double gap,
                          tf::boolean_options options = {}) {
    const std::vector<tf::mesh_view> views(meshes.begin(), meshes.end());
    options.gap = gap;
    tf::boolean_result result =
        tf::boolean(views, tf::boolean_expression::union_of(views.size()), options);
    REQUIRE(result.certificate);
    CHECK(test::is_clean_solid(result.mesh));
    for (const auto& [operand, index] : result.face_source) {
        REQUIRE(operand < meshes.size());
        CHECK(index < meshes[operand].faces.size());
    }
    for (std::size_t p = 0; p < result.mesh.points.size(); ++p)
        if (const auto& [operand, index] = result.vertex_source[p];
            operand != tf::operand_element::none) {
            REQUIRE(operand < meshes.size());
            CHECK(result.mesh.points[p] == meshes[operand].points[index]);
        }
    return result;
}

std::uint64_t shells(const tf::mesh& mesh) {
    return tf::count_topology(mesh.points.size(), mesh.faces).components_by_edge;
}

double volume_of_filled(const std::vector<tf::mesh>& meshes, double gap) {
    const tf::boolean_result result = filled(meshes, gap);
    CHECK(shells(result.mesh) == 1);
    return tf::signed_volume(result.mesh);
}

bool is_near(double a, double b) { return std::abs(a - b) <= 1e-12 * (1.0 + std::abs(b)); }

}  // namespace

TEST_CASE("filled gaps: exactly where faces lie over each other, up to the width and with it") {
    const tf::mesh cube = box(1, 1, 1), above = moved(box(1, 1, 1), {0.25, 0.5, 1.125});
    for (const double gap : {0.125, 0.2, 0.3})
        CHECK(volume_of_filled({cube, above}, gap) == 2.0 + 0.75 * 0.5 * 0.125);
    CHECK(volume_of_filled({above, cube}, 0.125) == 2.0 + 0.75 * 0.5 * 0.125);
    CHECK(filled({cube, above}, 0.125).statistics.filled_faces == 4);
}

TEST_CASE("filled gaps: a wider one changes nothing, bit for bit") {
    const std::vector<tf::mesh> two{box(1, 1, 1), moved(box(1, 1, 1), {0.25, 0.5, 1.125})};
    const tf::boolean_result wider = filled(two, 0.1249999), as_ever = filled(two, 0.0);
    CHECK(wider.mesh == as_ever.mesh);
    CHECK(wider.face_source == as_ever.face_source);
    CHECK(wider.statistics.filled_faces == 0);
    CHECK(shells(wider.mesh) == 2);
}

TEST_CASE("filled gaps: where no vertex is near another, between crossed bars") {
    const tf::mesh bar = moved(box(10, 1, 1), {-5, -0.5, 0});
    const tf::mesh across = moved(box(1, 10, 1), {-0.5, -5, 1.0625});
    CHECK(is_near(volume_of_filled({bar, across}, 0.125), 20.0 + 0.0625));
    const tf::mesh skew = moved(turned(bar, {0, 0, 1}, 0.7), {0, 0, 1.0625});
    CHECK(is_near(volume_of_filled({bar, skew}, 0.125), 20.0 + 0.0625 / std::sin(0.7)));
}

TEST_CASE("filled gaps: under a small cube, its sides get no skirt") {
    const tf::mesh plate = moved(box(20, 20, 1), {-10, -10, -1.0});
    const tf::mesh cube = moved(box(1, 1, 1), {0.3, 0.4, 0.0625});
    for (const double gap : {0.0625, 0.25, 0.9})
        CHECK(is_near(volume_of_filled({plate, cube}, gap), 401.0 + 0.0625));
}

TEST_CASE("filled gaps: three operands in a row, and one that is inside out") {
    const std::vector<tf::mesh> row{box(1, 1, 1), moved(box(1, 1, 1), {1.125, 0, 0}),
                                    moved(box(1, 1, 1), {2.25, 0, 0})};
    CHECK(volume_of_filled(row, 0.25) == 3.25);
    CHECK(volume_of_filled({row[0], inside_out(row[1]), row[2]}, 0.25) == 3.25);
    CHECK(volume_of_filled(row, 1.3) == 3.25);  // also across the one between
}

TEST_CASE("filled gaps: between faces that lean, that touch, and that meet") {
    const tf::mesh base = moved(box(4, 4, 1), {-2, -2, -1});
    const tf::mesh leaning = turned(moved(box(2, 2, 1), {-1, -1, 0}), {0, 1, 0}, 0.05);
    // Its edge is 0.05 below the other's top; the wedge behind that gets filled.
    CHECK(filled({base, moved(leaning, {0, 0, 0.01})}, 0.2).statistics.filled_faces > 0);
    CHECK(shells(filled({base, moved(leaning, {0, 0, 0.06})}, 0.2).mesh) == 1);
    const std::vector<tf::mesh> touching{box(1, 1, 1), moved(box(1, 1, 1), {0, 0, 1})};
    CHECK(volume_of_filled(touching, 0.5) == 2.0);
    CHECK(filled(touching, 0.5).statistics.filled_faces == 0);
}

TEST_CASE("filled gaps: a pin in a hole becomes one with it, without seams, however it is turned") {
    const tf::mesh block = moved(box(4, 4, 2), {-2, -2, 0});
    const tf::mesh with_hole = tf::difference(block, moved(prism(24, 1.0, 4), {0, 0, -1})).value();
    const double area = 24 * 0.5 * std::sin(0.2617993877991494);  // of the polygon of radius 1
    for (const double turn : {0.0, 0.1, 0.13}) {
        const tf::mesh pin = moved(turned(prism(24, 0.98, 3), {0, 0, 1}, turn), {0, 0, -0.5});
        const tf::mesh solid = filled({with_hole, pin}, 0.05).mesh;
        CHECK(shells(solid) == 1);
        CHECK(is_near(tf::signed_volume(solid), 32.0 + area * 0.98 * 0.98));
    }
}

TEST_CASE("filled gaps: by any rule, in floats, with groups of faces, with cuts kept") {
    const std::vector<tf::mesh> two{box(1, 1, 1), moved(box(1, 1, 1), {0.25, 0.5, 1.125})};
    const std::vector<std::uint32_t> groups(24, 7);
    for (const tf::fill_rule rule :
         {tf::fill_rule::nonzero, tf::fill_rule::even_odd, tf::fill_rule::positive})
        CHECK(tf::signed_volume(filled(two, 0.2, {.fill_rule = rule}).mesh) == 2.046875);
    CHECK(shells(filled(two, 0.2, {.precision = tf::precision::float32}).mesh) == 1);
    CHECK(filled(two, 0.2, {.face_groups = groups}).mesh == filled(two, 0.2).mesh);
    CHECK(filled(two, 0.2, {.keep_cuts = true}).mesh.faces.size() >
          filled(two, 0.2).mesh.faces.size());
    const std::vector<std::uint32_t> too_few(23, 7);
    CHECK_THROWS_AS(filled(two, 0.2, {.face_groups = too_few}), std::invalid_argument);
}

TEST_CASE(
    "filled gaps: in coordinates near the ends of their range, far from the origin, by soups") {
    const std::vector<tf::mesh> two{box(1, 1, 1), moved(box(1, 1, 1), {0.25, 0.5, 1.125})};
    for (const double scale : {0x1p-600, 0x1p-300, 0x1p300, 0x1p600}) {
        std::vector<tf::mesh> scaled = two;
        for (tf::mesh& mesh : scaled)
            for (tf::point3& p : mesh.points) p = {p.x * scale, p.y * scale, p.z * scale};
        const tf::boolean_result result = filled(scaled, 0.2 * scale);
        if (scale > 0x1p-500 && scale < 0x1p500) CHECK(result.statistics.filled_faces == 4);
    }
    CHECK(volume_of_filled({moved(two[0], {0x1p30, 0, 0}), moved(two[1], {0x1p30, 0, 0})}, 0.2) ==
          2.046875);
    std::vector<tf::mesh> soups(2);  // as of an STL
    for (std::size_t k = 0; k < 2; ++k)
        for (const tf::face& f : two[k].faces) {
            const auto first = static_cast<std::uint32_t>(soups[k].points.size());
            for (const std::uint32_t corner : f) soups[k].points.push_back(two[k].points[corner]);
            soups[k].faces.push_back({first, first + 1, first + 2});
        }
    CHECK(volume_of_filled(soups, 0.2) == 2.046875);
}

TEST_CASE("filled gaps: of turned boxes and balls, nothing is taken away, no piece floats") {
    test::random source(11);
    for (int round = 0; round < 30; ++round) {
        CAPTURE(round);
        std::vector<tf::mesh> solids;
        for (int k = 0; k < 3; ++k) {
            const tf::mesh one =
                k == 2 ? test::ball(2, 0.6)
                       : box(source.in(0.5, 1.5), source.in(0.5, 1.5), source.in(0.5, 1.5));
            solids.push_back(
                moved(turned(one, {source.in(-1, 1), source.in(-1, 1), 1}, source.in(0, 3)),
                      {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)}));
        }
        const tf::mesh apart = filled(solids, 0.0).mesh, whole = filled(solids, 0.3).mesh;
        CHECK(tf::signed_volume(whole) >= tf::signed_volume(apart) - 1e-12);
        const auto outward = [](const tf::mesh& mesh) {  // shells that are no voids
            const auto part = tf::face_components(mesh.points.size(), mesh.faces);
            std::vector<tf::mesh> parts;
            for (std::size_t f = 0; f < part.size(); ++f) {
                if (part[f] == parts.size()) parts.push_back({mesh.points, {}});
                parts[part[f]].faces.push_back(mesh.faces[f]);
            }
            return std::count_if(parts.begin(), parts.end(),
                                 [](const tf::mesh& m) { return tf::signed_volume(m) > 0.0; });
        };
        CHECK(outward(whole) <= outward(apart));
    }
}

TEST_CASE("filled gaps: of a union of all operands only, and no gap that is none") {
    const std::vector<tf::mesh> two{box(1, 1, 1), moved(box(1, 1, 1), {0, 0, 1.125})};
    const std::vector<tf::mesh_view> views(two.begin(), two.end());
    const auto made = [&](const char* formula, double gap) {
        return tf::boolean(views, {formula, 2}, {.gap = gap});
    };
    CHECK(made("b+a+b", 0.2).statistics.filled_faces == 4);
    for (const char* formula : {"a-b", "a*b", "a^b", "a", "a+b-b"})
        CHECK_THROWS_AS(made(formula, 0.2), std::invalid_argument);
    for (const double bad :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(made("a+b", bad), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::split(views, {.gap = 0.1})), std::invalid_argument);
    CHECK(tf::boolean({}, tf::boolean_expression::union_of(0), {.gap = 0.1}).mesh.faces.empty());
    const tf::boolean_result open =
        tf::unite(tf::mesh{two[0].points, {two[0].faces.begin(), two[0].faces.end() - 1}}, two[1],
                  {.gap = 0.2});
    CHECK(open.certificate.status == tf::status::open_input);
    CHECK(open.statistics.filled_faces == 0);
}
