/// \file
/// Random expressions of crowds of solids, with their volumes in rationals: touching, on each
/// other, inside out, hidden in each other, as operands and as parts of one.
///
/// TREEFORM_STRESS_COUNT sets the expressions of each kind (default 30), TREEFORM_STRESS_SEED the
/// seed.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/random.hpp>
#include <support/rational_volume.hpp>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::inside_out;
using test::moved;
using test::on_lattice;
using test::random_tetrahedron;
using test::together;

constexpr double side = 8.0;

enum class shape : std::uint8_t { boxes, balls, tetrahedra, turned_boxes, all };

tf::mesh random_solid(test::random& source, shape of, double steps) {
    if (of == shape::all) of = static_cast<shape>(source.below(4));
    const tf::point3 at{source.in(0, side), source.in(0, side), source.in(0, side)};
    tf::mesh solid;
    switch (of) {
        case shape::balls:
            solid = ball(2, source.in(1.0, 4.0));
            break;
        case shape::tetrahedra:
            solid = random_tetrahedron(source, 4.0);
            break;
        case shape::turned_boxes:
            solid = test::turned(box(source.in(1, 5), source.in(1, 5), source.in(1, 5)),
                                 {source.in(-1, 1), source.in(-1, 1), 1.0}, source.in(0, 3));
            break;
        default:
            solid = box(1 + std::floor(source.in(0, 4)), 1 + std::floor(source.in(0, 4)),
                        1 + std::floor(source.in(0, 4)));
            return moved(source.below(8) == 0 ? inside_out(solid) : solid,
                         {std::round(at.x), std::round(at.y), std::round(at.z)});
    }
    solid = on_lattice(moved(solid, at), steps);
    return source.below(8) == 0 ? inside_out(solid) : solid;
}

std::string name(std::size_t operand) {
    std::string result(1, static_cast<char>('a' + operand % 26));
    if (operand >= 26) result.insert(0, 1, static_cast<char>('a' + operand / 26 - 1));
    return result;
}

/// Unions most of all, as it is in life; sometimes differences or all sorts.
std::string random_formula(test::random& source, std::size_t operands) {
    const std::array<const char*, 4> kinds = {"+", "-", "++-", "+-*^"};
    const std::string operations = kinds[source.below(kinds.size())];
    std::string result = name(0);
    for (std::size_t k = 1; k < operands; ++k) {
        const char operation = operations[source.below(operations.size())];
        result = source.below(5) == 0 ? name(k) + operation + "(" + result + ")"
                                      : "(" + result + ")" + operation + name(k);
    }
    return result;
}

/// \return faces that were not looked at
std::uint64_t check_random(test::random& source, shape of) {
    const double steps = source.below(2) == 0 ? 0.0 : 1.0 + static_cast<double>(source.below(3));
    const std::size_t solids = 2 + source.below(39);
    const std::size_t most_operands = 1 + source.below(solids);
    std::vector<tf::mesh> operands;
    for (std::size_t i = 0; i < solids; ++i) {
        tf::mesh solid = random_solid(source, of, steps);
        if (operands.size() < most_operands)
            operands.push_back(std::move(solid));
        else
            operands[i % most_operands] =
                together(std::move(operands[i % most_operands]), std::move(solid));
    }
    const tf::boolean_expression expression(random_formula(source, operands.size()),
                                            operands.size());
    const auto rule = static_cast<tf::fill_rule>(source.below(3));
    const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
    const tf::boolean_result result = tf::boolean(views, expression, {.fill_rule = rule});
    const test::exact_arrangement arranged(operands, rule);
    CHECK(arranged.closed() == (result.certificate.status != tf::status::open_input));
    if (!arranged.closed() || !result.certificate) return 0;
    const mpf_class exact = test::exact_volumes(arranged, {&expression, 1})[0];
    const mpf_class off = abs(mpf_class(test::volume_of(result.mesh), 1024) - exact);
    // The points that were rounded, times an area of no more than the faces have.
    CHECK(off.get_d() <= 1e5 * (result.certificate.max_displacement + 1e-300));
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    return result.statistics.skipped_faces;
}

void check_many(shape of, std::uint64_t salt) {
    const std::uint64_t seed = test::stress_seed() * 1000 + salt;
    test::random seeds(seed);
    std::uint64_t skipped = 0;
    for (std::uint64_t i = 0; i < test::stress_count(30); ++i) {
        const std::uint64_t own = seeds.bits();
        CAPTURE(own);
        test::random source(own);
        skipped += check_random(source, of);
    }
    MESSAGE("faces not looked at: " << skipped);
    CHECK(skipped > 0);
}

}  // namespace

TEST_CASE("random expressions: boxes of whole numbers") { check_many(shape::boxes, 1); }
TEST_CASE("random expressions: balls") { check_many(shape::balls, 2); }
TEST_CASE("random expressions: tetrahedra") { check_many(shape::tetrahedra, 3); }
TEST_CASE("random expressions: turned boxes") { check_many(shape::turned_boxes, 4); }
TEST_CASE("random expressions: all sorts") { check_many(shape::all, 5); }
