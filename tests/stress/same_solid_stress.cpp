/// \file
/// Random expressions of 2 to 40 operands: what is left out as hidden changes no solid.
///
/// Each is made in two ways: all faces cut, each cell asked about by itself; and with hidden faces
/// left out, in boxes far smaller than `boolean` takes, and however little that saves. The two
/// surfaces are compared before any rounding, as rational numbers (support/exact_chain.hpp): equal
/// means equal as solids, for all coordinates, however differently they are cut into triangles.
///
/// Then what `boolean` itself returns is compared with them in the same way, where rounding moved
/// nothing: on lattices that is the rule. Where it moved something, the rounded solid is another
/// one; how far off it may be is what expressions_stress asks.
///
/// TREEFORM_STRESS_COUNT sets the expressions of each kind (default 40), TREEFORM_STRESS_SEED the
/// seed.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/both_ways.hpp>
#include <support/exact_chain.hpp>
#include <support/random.hpp>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/was_mended.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::inside_out;
using test::moved;
using test::on_lattice;
using test::random_tetrahedron;
using test::together;

constexpr double room_side = 8.0;

/// Two points, and a closed line that runs around between them, twice or as it likes: one piece
/// that may meet itself, and wind around space several times or the other way round.
tf::mesh random_bipyramid(test::random& source, double size) {
    tf::mesh solid;
    const auto corners = static_cast<std::uint32_t>(4 + source.below(4));
    const bool is_twice = source.below(2) == 0;
    solid.points = {{0, 0, size}, {0, 0, -size}};
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double turn = 4 * std::numbers::pi * (i + source.in(-0.2, 0.2)) / corners;
        solid.points.push_back(is_twice
                                   ? tf::point3{size * std::cos(turn), size * std::sin(turn), 0}
                                   : tf::point3{source.in(-size, size), source.in(-size, size), 0});
        const std::uint32_t here = 2 + i, next = 2 + (i + 1) % corners;
        solid.faces.push_back({here, next, 0});
        solid.faces.push_back({next, here, 1});
    }
    return solid;
}

/// Each face cut in four, `levels` times: space is divided by boxes of faces, and those of few
/// large faces leave no room between them.
tf::mesh in_small_faces(tf::mesh mesh, int levels) {
    for (int level = 0; level < levels; ++level) {
        tf::mesh next;
        for (const auto& [a, b, c] : mesh.faces) {
            const auto middle = [&](std::uint32_t i, std::uint32_t j) {
                const tf::point3 p = mesh.points[i], q = mesh.points[j];
                return tf::point3{0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)};
            };
            const auto first = static_cast<std::uint32_t>(next.points.size());
            next.points.insert(next.points.end(), {mesh.points[a], mesh.points[b], mesh.points[c],
                                                   middle(a, b), middle(b, c), middle(c, a)});
            for (const auto& [i, j, k] : {tf::face{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
                next.faces.push_back({first + i, first + j, first + k});
        }
        mesh = std::move(next);
    }
    return mesh;
}

enum class solid_shape : std::uint8_t { boxes, balls, tetrahedra, bipyramids, turned_boxes, all };

tf::mesh solid_of(test::random& source, solid_shape of, double size, double steps) {
    if (of == solid_shape::all) of = static_cast<solid_shape>(source.below(5));
    tf::point3 at{source.in(0, room_side), source.in(0, room_side), source.in(0, room_side)};
    if (size > room_side) at = {0.5 * room_side, 0.5 * room_side, 0.5 * room_side};
    const auto length = [&] { return source.in(0.3, 1.0) * size; };
    tf::mesh solid;
    switch (of) {
        case solid_shape::balls:
            solid = ball(source.below(8) == 0 ? 2 : 1, 0.7 * length());
            break;
        case solid_shape::tetrahedra:
            solid = random_tetrahedron(source, 0.8 * size);
            break;
        case solid_shape::bipyramids:
            solid = random_bipyramid(source, 0.6 * size);
            break;
        case solid_shape::turned_boxes:
            solid = test::turned(box(length(), length(), length()),
                                 {source.in(-1, 1), source.in(-1, 1), 1.0}, source.in(0, 3));
            break;
        default:
            solid =
                on_lattice(box(std::ceil(length()), std::ceil(length()), std::ceil(length())), 1.0);
            steps = 1.0;
    }
    solid = on_lattice(moved(std::move(solid), at), steps);
    return source.below(8) == 0 ? inside_out(solid) : solid;
}

std::string operand_name(std::size_t operand) {
    std::string result(1, static_cast<char>('a' + operand % 26));
    if (operand >= 26) result.insert(0, 1, static_cast<char>('a' + operand / 26 - 1));
    return result;
}

/// Operands from `first` on, in brackets at random. Unions most of all, as it is in life.
std::string formula_of(test::random& source, const std::string& operations, std::size_t first,
                       std::size_t operands) {
    if (operands == 1) return operand_name(first);
    const std::size_t left = source.below(3) == 0 ? 1 + source.below(operands - 1) : operands - 1;
    const char operation = operations[source.below(operations.size())];
    return "(" + formula_of(source, operations, first, left) + ")" + operation + "(" +
           formula_of(source, operations, first + left, operands - left) + ")";
}

struct question {
    std::vector<tf::mesh> operands{};
    std::string formula{};
    tf::boolean_options options{};

    [[nodiscard]] tf::boolean_expression expression() const { return {formula, operands.size()}; }
    [[nodiscard]] std::vector<tf::mesh_view> views() const {
        return {operands.begin(), operands.end()};
    }
};

/// The more operands, the smaller: a few of them meet at a place, whatever their number. At times
/// all of them are in the first or near its surface.
question random_question(test::random& source, solid_shape of) {
    question result;
    const double steps = source.below(3) == 0 ? 0.0 : 1.0 + static_cast<double>(source.below(3));
    const std::size_t operands = 2 + source.below(39);
    const double size = room_side * std::cbrt(source.in(1.0, 4.0) / static_cast<double>(operands));
    const bool in_a_large_one = source.below(6) == 0;
    for (std::size_t k = 0; k < operands; ++k) {
        const bool is_large = k == 0 && in_a_large_one;
        tf::mesh operand = solid_of(source, of, is_large ? 2.5 * room_side : size, steps);
        if (is_large)
            operand = in_small_faces(std::move(operand), of == solid_shape::balls ? 1 : 3);
        if (source.below(40) == 0) operand = {};
        while (source.below(4) == 0)  // parts, which may meet, too
            operand = together(std::move(operand), solid_of(source, of, size, steps));
        if (k > 0 && source.below(20) == 0) operand = result.operands[source.below(k)];
        result.operands.push_back(std::move(operand));
    }
    constexpr std::array<const char*, 5> kinds = {"+", "-", "++-", "+-*", "+-*^"};
    result.formula = formula_of(source, kinds[source.below(kinds.size())], 0, operands);
    result.options.fill_rule = static_cast<tf::fill_rule>(source.below(3));
    result.options.merge_coplanar = source.below(2) == 0;
    return result;
}

struct counts {
    std::uint64_t expressions = 0, left_out = 0, uncut = 0, faces = 0;
    std::uint64_t as_is = 0;    ///< results of `boolean` that rounding did not move
    std::uint64_t skipped = 0;  ///< results of `boolean` with faces left out
    std::uint64_t again = 0;    ///< asked for again, of other threads and prepared operands
};

void check_same_bytes(const tf::boolean_result& result, const tf::boolean_result& again) {
    CHECK(again.mesh == result.mesh);
    CHECK(again.face_source == result.face_source);
    CHECK(again.vertex_source == result.vertex_source);
    CHECK(again.certificate.status == result.certificate.status);
    CHECK(again.certificate.max_displacement == result.certificate.max_displacement);
}

/// On 2 and on 5 threads, and of prepared operands.
void check_again(const question& asked, const tf::boolean_result& result) {
    for (const unsigned threads : {2U, 5U}) {
        const tf::thread_scope some(threads);
        check_same_bytes(result, tf::boolean(asked.views(), asked.expression(), asked.options));
    }
    std::vector<tf::prepared_mesh> prepared;
    for (const tf::mesh& operand : asked.operands)
        prepared.push_back(tf::prepared_mesh::borrow(operand));
    const std::vector<tf::mesh_ref> operands(prepared.begin(), prepared.end());
    check_same_bytes(result, tf::boolean(operands, asked.expression(), asked.options));
}

void check_same(const question& asked, test::random& source, counts& sums) {
    const tf::boolean_expression expression = asked.expression();
    const tf::fill_rule rule = asked.options.fill_rule;
    test::exact_numbers numbers;
    const test::exact_chain all = test::surface_of_all(asked.operands, expression, rule, numbers);
    // Boxes of all sizes, and at times those of `boolean`.
    tf::detail::boolean::division_limits limits;
    if (source.below(4) != 0)
        limits = {.effort = source.in(0.1, 8.0),
                  .faces_not_halved = 1 + source.below(8),
                  .few_components = source.below(3)};
    const auto some = test::surface_of_undecided(asked.operands, expression, rule, limits, numbers);
    ++sums.expressions;
    sums.faces += all.parts.size();
    CHECK(test::is_same_surface(all, some.chain, numbers));
    sums.left_out += some.left_out;
    sums.uncut += some.uncut;

    const tf::boolean_result result = tf::boolean(asked.views(), expression, asked.options);
    CHECK(result.certificate.status != tf::status::open_input);
    if (result.statistics.skipped_faces > 0) ++sums.skipped;
    if (result.certificate && result.certificate.max_displacement == 0.0 &&
        !test::was_mended(result.statistics)) {
        CHECK(test::is_same_surface(all, test::chain_of(result.mesh, numbers), numbers));
        ++sums.as_is;
    }
    if (source.below(8) == 0) {
        check_again(asked, result);
        ++sums.again;
    }
}

void check_many_same(solid_shape of, std::uint64_t salt) {
    const tf::thread_scope one(1);
    test::random seeds(test::stress_seed() * 1000 + salt);
    counts sums;
    for (std::uint64_t i = 0; i < test::stress_count(40); ++i) {
        const std::uint64_t own = seeds.bits();
        CAPTURE(own);
        test::random source(own);
        const question asked = random_question(source, of);
        CAPTURE(asked.formula);
        check_same(asked, source, sums);
    }
    MESSAGE(sums.expressions << " expressions, " << sums.faces << " faces; left out "
                             << sums.left_out << ", pairs not cut " << sums.uncut
                             << "; by boolean: unmoved " << sums.as_is << ", with faces left out "
                             << sums.skipped << ", asked again " << sums.again);
    CHECK(sums.left_out > 0);
    CHECK(sums.as_is > 0);
}

}  // namespace

TEST_CASE("exact chains: the same solid cut otherwise is the same, and no other is") {
    test::exact_numbers numbers;
    const tf::mesh whole = box(2, 1, 1), half = box(1, 1, 1);
    const tf::mesh halves = together(half, moved(half, {1, 0, 0}));
    const auto chain = [&](const tf::mesh& mesh) { return test::chain_of(mesh, numbers); };
    CHECK(test::is_same_surface(chain(whole), chain(halves), numbers));
    CHECK(!test::is_same_surface(chain(whole), chain(half), numbers));
    CHECK(!test::is_same_surface(chain(whole), chain(inside_out(whole)), numbers));
    CHECK(!test::is_same_surface(chain(whole), chain(together(whole, whole)), numbers));
    CHECK(!test::is_same_surface(chain(whole), chain(moved(whole, {0, 0x1p-52, 0})), numbers));
    CHECK(test::is_same_surface(chain(together(whole, inside_out(halves))), chain({}), numbers));
}

TEST_CASE("same solid: boxes of whole numbers") { check_many_same(solid_shape::boxes, 1); }
TEST_CASE("same solid: balls") { check_many_same(solid_shape::balls, 2); }
TEST_CASE("same solid: tetrahedra") { check_many_same(solid_shape::tetrahedra, 3); }
TEST_CASE("same solid: pieces that meet themselves") {
    check_many_same(solid_shape::bipyramids, 4);
}
TEST_CASE("same solid: turned boxes") { check_many_same(solid_shape::turned_boxes, 5); }
TEST_CASE("same solid: all sorts") { check_many_same(solid_shape::all, 6); }
