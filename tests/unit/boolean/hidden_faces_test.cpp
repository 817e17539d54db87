/// \file
/// What cannot bound the result is not looked at, and the result is the same.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::inside_out;
using test::moved;
using test::together;

constexpr int side = 12;

/// A box whose sides are cut into squares of side 1.
tf::mesh box_of_squares(const std::array<int, 3>& low, const std::array<int, 3>& high) {
    tf::mesh result;
    for (std::size_t k = 0; k < 3; ++k)
        for (const bool is_high : {false, true}) {
            const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
            for (int i = low[u]; i < high[u]; ++i)
                for (int j = low[v]; j < high[v]; ++j) {
                    const auto first = static_cast<std::uint32_t>(result.points.size());
                    for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                        tf::point3 p;
                        p[k] = is_high ? high[k] : low[k];
                        p[u] = i + di;
                        p[v] = j + dj;
                        result.points.push_back(p);
                    }
                    const tf::face f{first, first + 1, first + 2}, g{first, first + 2, first + 3};
                    for (const auto& [a, b, c] : {f, g})
                        result.faces.push_back(is_high ? tf::face{a, b, c} : tf::face{a, c, b});
                }
        }
    return result;
}

/// Boxes of whole numbers in [0, side]^3, of which some are inside out, and what they wind around.
struct crowd {
    tf::mesh mesh;
    std::vector<int> winding = std::vector<int>(std::size_t{side} * side * side, 0);

    void add(const std::array<int, 3>& low, const std::array<int, 3>& high, bool out) {
        const tf::mesh b = box_of_squares(low, high);
        mesh = together(std::move(mesh), out ? inside_out(b) : b);
        for (int x = low[0]; x < high[0]; ++x)
            for (int y = low[1]; y < high[1]; ++y)
                for (int z = low[2]; z < high[2]; ++z)
                    winding[static_cast<std::size_t>((x * side + y) * side + z)] += out ? -1 : 1;
    }
};

crowd random_crowd(test::random& source, std::size_t boxes) {
    crowd result;
    for (std::size_t i = 0; i < boxes; ++i) {
        std::array<int, 3> low{}, high{};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = static_cast<int>(source.below(side - 1));
            high[k] = low[k] + 1 +
                      static_cast<int>(source.below(static_cast<std::size_t>(side - low[k])));
        }
        result.add(low, high, source.below(8) == 0);
    }
    return result;
}

bool is_inside(tf::fill_rule rule, int winding) {
    if (rule == tf::fill_rule::even_odd) return winding % 2 != 0;
    return rule == tf::fill_rule::positive ? winding > 0 : winding != 0;
}

std::string formula_of_crowds(test::random& source, std::size_t operands) {
    std::string result = "a";
    for (std::size_t k = 1; k < operands; ++k) {
        const std::string next(1, static_cast<char>('a' + k));
        const char operation = "+++-*^"[source.below(6)];
        result = source.below(4) == 0 ? next + operation + "(" + result + ")"
                                      : "(" + result + ")" + operation + next;
    }
    return result;
}

}  // namespace

TEST_CASE("hidden faces: crowds of boxes are what voxels say") {
    test::random source(7);
    std::uint64_t skipped = 0;
    for (int run = 0; run < 60; ++run) {
        const std::size_t operands = 1 + source.below(6);
        std::vector<crowd> crowds;
        for (std::size_t k = 0; k < operands; ++k)
            crowds.push_back(random_crowd(source, 1 + source.below(40 / operands)));
        const tf::boolean_expression expression(formula_of_crowds(source, operands), operands);
        const auto rule = static_cast<tf::fill_rule>(source.below(3));
        CAPTURE(run);
        double voxels = 0.0;
        for (std::size_t v = 0; v < crowds[0].winding.size(); ++v) {
            std::array<bool, 6> in{};
            for (std::size_t k = 0; k < operands; ++k)
                in[k] = is_inside(rule, crowds[k].winding[v]);
            voxels += expression(std::span(in.data(), operands)) ? 1.0 : 0.0;
        }
        std::vector<tf::mesh_view> views;
        for (const crowd& c : crowds) views.emplace_back(c.mesh);
        const tf::boolean_result result =
            tf::boolean(views, expression, {.fill_rule = rule, .merge_coplanar = run % 3 == 0});
        REQUIRE(result.certificate);
        CHECK(tf::signed_volume(result.mesh) == voxels);
        CHECK(tf::self_intersections(result.mesh).pairs.empty());
        skipped += result.statistics.skipped_faces;
    }
    CHECK(skipped > 1000);
}

TEST_CASE("hidden faces: what is deep inside costs nothing and changes nothing") {
    // 300 little balls in a large one, some of them through each other.
    test::random source(5);
    const tf::mesh large = ball(4, 1);
    tf::mesh little;
    for (int i = 0; i < 300; ++i) {
        const double r = 0.5 * std::cbrt(source.unit());
        const double z = source.in(-1, 1), turn = source.in(0, 6.28);
        const double flat = std::sqrt(1 - z * z);
        little = together(little, moved(ball(2, 0.1), {r * flat * std::cos(turn),
                                                       r * flat * std::sin(turn), r * z}));
    }
    const auto as_operands = [&](const char* expression, const tf::boolean_options& options = {}) {
        const std::array<tf::mesh_view, 2> views{large, little};
        return tf::boolean(views, tf::boolean_expression(expression, 2), options);
    };
    SUBCASE("of a union") {
        const tf::boolean_result both = as_operands("a+b");
        REQUIRE(both.certificate);
        CHECK(both.statistics.skipped_faces >= little.faces.size());
        CHECK(both.mesh.faces.size() == large.faces.size());
        CHECK(both.mesh.points == large.points);
    }
    SUBCASE("of one file") {
        const tf::mesh all = together(little, large);
        const tf::boolean_result result =
            tf::boolean(std::array<tf::mesh_view, 1>{all}, tf::boolean_expression::union_of(1));
        REQUIRE(result.certificate);
        CHECK(result.statistics.skipped_faces >= little.faces.size());
        CHECK(result.mesh.faces.size() == large.faces.size());
        for (std::size_t f = 0; f < result.face_source.size(); ++f)
            CHECK(result.face_source[f].index >= little.faces.size());
    }
    SUBCASE("but a hollow in it is there") {
        const tf::mesh hollow = inside_out(moved(ball(2, 0.1), {0, 0, 0.8}));
        const tf::mesh all = together(together(little, large), hollow);
        const tf::boolean_result result =
            tf::boolean(std::array<tf::mesh_view, 1>{all}, tf::boolean_expression::union_of(1));
        REQUIRE(result.certificate);
        CHECK(result.mesh.faces.size() == large.faces.size() + hollow.faces.size());
        const tf::boolean_result positive =
            tf::boolean(std::array<tf::mesh_view, 1>{all}, tf::boolean_expression::union_of(1),
                        {.fill_rule = tf::fill_rule::positive});
        CHECK(positive.mesh.faces.size() == large.faces.size() + hollow.faces.size());
    }
    SUBCASE("nothing is left of a difference") {
        const tf::boolean_result none = as_operands("b-a");
        REQUIRE(none.certificate);
        CHECK(none.mesh.faces.empty());
        CHECK(none.statistics.skipped_faces > 0);
    }
    SUBCASE("all of the crowd is the intersection") {
        const tf::boolean_result inner = as_operands("a*b"), alone = as_operands("b");
        REQUIRE(inner.certificate);
        CHECK(inner.mesh.points.size() == alone.mesh.points.size());
        CHECK(tf::signed_volume(inner.mesh) == doctest::Approx(tf::signed_volume(alone.mesh)));
    }
    SUBCASE("and a hidden surface that is open is refused all the same") {
        little.faces.pop_back();
        const tf::boolean_result refused = as_operands("a+b");
        CHECK(refused.certificate.status == tf::status::open_input);
        CHECK(refused.certificate.boundary_edges == 3);
    }
}

TEST_CASE("hidden faces: the same bytes on any number of threads") {
    test::random source(11);
    std::vector<tf::mesh> balls;
    for (int i = 0; i < 60; ++i)
        balls.push_back(moved(ball(3, source.in(0.5, 1.0)),
                              {source.in(0, 2), source.in(0, 2), source.in(0, 2)}));
    const std::vector<tf::mesh_view> views(balls.begin(), balls.end());
    const auto expression = tf::boolean_expression::union_of(balls.size());
    const tf::boolean_result many = tf::boolean(views, expression);
    REQUIRE(many.certificate);
    CHECK(many.statistics.skipped_faces > 1000);
    const tf::thread_scope one(1);
    const tf::boolean_result alone = tf::boolean(views, expression);
    CHECK(alone.mesh.points == many.mesh.points);
    CHECK(alone.mesh.faces == many.mesh.faces);
    CHECK(alone.statistics.skipped_faces == many.statistics.skipped_faces);
}

TEST_CASE("hidden faces: long ones, too, whose boxes reach far beyond them") {
    test::random source(5);
    tf::mesh rod = ball(3, 1.0);
    for (tf::point3& p : rod.points) p.z *= 2.5;
    std::vector<tf::mesh> rods;
    for (int i = 0; i < 40; ++i)
        rods.push_back(
            test::turned(rod, {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)}, 3.0));
    const std::vector<tf::mesh_view> views(rods.begin(), rods.end());
    const tf::boolean_result all =
        tf::boolean(views, tf::boolean_expression::union_of(rods.size()));
    REQUIRE(all.certificate);
    const std::size_t faces = rods.size() * rod.faces.size();
    CHECK(all.statistics.skipped_faces > faces / 3);
    tf::mesh one_by_one;
    for (const tf::mesh& next : rods) one_by_one = tf::unite(one_by_one, next).mesh;
    CHECK(tf::signed_volume(all.mesh) ==
          doctest::Approx(tf::signed_volume(one_by_one)).epsilon(1e-12));
}
