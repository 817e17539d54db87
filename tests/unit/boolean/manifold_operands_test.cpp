#include <libmesh/boolean/cut_operand.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/same_boolean.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/whole_boolean.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::check_same_boolean;
using test::inside_out;
using test::moved;
using test::together;
using operands = std::array<tf::mesh, 2>;

constexpr std::array rules{tf::fill_rule::nonzero, tf::fill_rule::even_odd,
                           tf::fill_rule::positive};
constexpr std::array formulas{"a+b", "a*b", "a-b", "b-a", "a^b", "a", "b"};

/// The results are those of all faces, for all formulas and rules.
void check_both_ways(const operands& pair) {
    for (const tf::fill_rule rule : rules)
        for (const std::string text : formulas) {
            CAPTURE(text);
            CAPTURE(static_cast<int>(rule));
            const auto whole = test::whole_boolean({pair[0], pair[1]}, text, {.fill_rule = rule});
            check_same_boolean(tf::boolean({pair[0], pair[1]}, {text, 2}, {.fill_rule = rule}),
                               whole);
        }
}

/// Of one operand alone, too.
void check_alone(const tf::mesh& mesh) {
    for (const tf::fill_rule rule : rules) {
        CAPTURE(static_cast<int>(rule));
        const tf::boolean_result whole = test::whole_boolean({mesh}, "a", {.fill_rule = rule});
        check_same_boolean(tf::boolean({mesh}, {"a", 1}, {.fill_rule = rule}), whole);
    }
}

/// Two points, and a closed line that runs around between them, twice or as it likes: it may meet
/// itself, and wind around space several times or the other way round.
tf::mesh random_bipyramid(test::random& source) {
    tf::mesh solid;
    const auto corners = static_cast<std::uint32_t>(4 + source.below(4));
    const bool is_twice = source.below(2) == 0;
    solid.points = {{0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double turn = 4 * std::numbers::pi * (i + source.in(-0.2, 0.2)) / corners;
        solid.points.push_back(is_twice ? tf::point3{std::cos(turn), std::sin(turn), 0}
                                        : tf::point3{source.in(-1, 1), source.in(-1, 1), 0});
        const std::uint32_t here = 2 + i, next = 2 + (i + 1) % corners;
        solid.faces.push_back({here, next, 0});
        solid.faces.push_back({next, here, 1});
    }
    return solid;
}

tf::mesh random_part(test::random& source) {
    const auto at = [&] {
        return tf::point3{source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)};
    };
    tf::mesh part = source.below(2) == 0 ? random_bipyramid(source)
                                         : test::random_tetrahedron(source, source.in(0.5, 3));
    part = moved(std::move(part), at());
    return source.below(3) == 0 ? inside_out(part) : part;
}

}  // namespace

TEST_CASE("manifold operands: what is examined is told") {
    namespace engine = tf::detail::boolean;
    const auto known = [](const tf::mesh& mesh, const auto& look) {
        const auto prepared = tf::prepared_mesh::borrow(mesh);
        return look(engine::cut_operand_of(prepared), prepared);
    };
    const auto without_fan = [&](const tf::mesh& mesh) {
        return known(mesh, [](const auto& of, const auto&) { return of.without_fan.size(); });
    };
    const auto few_pairs = [&](const tf::mesh& mesh) {
        return known(mesh, [](const auto&, const auto& prepared) {
            return engine::few_own_pairs(prepared, {}).has_value();
        });
    };
    CHECK(without_fan(ball(3, 1.0)) == 0);
    CHECK(few_pairs(ball(3, 1.0)));
    CHECK(few_pairs(together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02}))));
    const tf::mesh crossing = together(ball(2, 1.0), moved(ball(2, 1.0), {0.1, 0.2, 0.3}));
    CHECK_FALSE(few_pairs(crossing));
    tf::mesh open = ball(3, 1.0);
    open.faces.pop_back();
    CHECK(without_fan(open) == 3);
    CHECK(known(open, [](const auto& of, const auto&) { return of.open.count; }) == 3);
    // two boxes with an edge in common, whose corners are there twice
    const tf::mesh touching = together(test::box(1, 1, 1), moved(test::box(1, 1, 1), {1, 1, 0}));
    CHECK(without_fan(touching) == 2);
    CHECK(known(touching, [](const auto& of, const auto& prepared) {
        return of.open.count == 0 && of.mesh(prepared).indexed_view().points.size() == 14;
    }));
    // A face without an area, on an edge that its neighbors have in parts, is left out.
    tf::mesh flat = test::box(1, 1, 1);
    const tf::face f = flat.faces[0];
    const auto at = [&](std::uint32_t p) { return flat.points[p]; };
    flat.points.push_back({0.5 * (at(f[0]).x + at(f[1]).x), 0.5 * (at(f[0]).y + at(f[1]).y),
                           0.5 * (at(f[0]).z + at(f[1]).z)});
    const auto middle = static_cast<std::uint32_t>(flat.points.size() - 1);
    flat.faces[0] = {f[0], middle, f[2]};
    flat.faces.push_back({middle, f[1], f[2]});
    flat.faces.push_back({f[0], f[1], middle});
    CHECK(known(flat, [](const auto& of, const auto&) {
        return of.degenerate == 1 && of.open.count == 0 && of.without_fan.size() >= 3;
    }));
    CHECK(tf::boolean({flat}, {"a", 1}).certificate);

    const auto prepared = tf::prepared_mesh::borrow(crossing);
    const auto pairs = engine::own_pairs(prepared, {});
    CHECK(std::vector<tf::face_pair>(pairs.begin(), pairs.end()) ==
          tf::self_intersections(crossing, {.vertices = tf::vertex_identity::by_index}).pairs);
}

TEST_CASE("manifold operands: parts that cross, nest, or are inside out give the general result") {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto wart = [&](double size) {
            return moved(ball(1, size), {1.0, source.in(-0.2, 0.2), source.in(-0.2, 0.2)});
        };
        tf::mesh a = together(ball(4, 1.0), wart(0.1));
        if (seed % 2 == 0) a = together(a, moved(ball(3, 0.3), {0.1, 0.2, source.in(-0.1, 0.1)}));
        if (seed % 3 == 0) a = together(a, inside_out(moved(ball(2, 0.2), {-0.5, 0, 0})));
        const tf::mesh clean = moved(ball(4, 1.0), {source.in(0.5, 1.5), source.in(-0.3, 0.3), 0});
        const tf::mesh b = together(moved(ball(4, 0.9), {source.in(0.5, 1.5), 0.1, 0.2}),
                                    moved(wart(0.2), {0.1, 0, 0}));
        check_alone(a);
        check_both_ways({a, clean});
        check_both_ways({clean, a});
        check_both_ways({a, b});
        check_both_ways({a, moved(b, {10, 0, 0})});
        check_both_ways({a, tf::mesh{}});
        check_both_ways({tf::mesh{}, a});
        check_both_ways({inside_out(a), a});
    }
}

TEST_CASE("manifold operands: heaps of solids that wind as they like give the general result") {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        operands pair;
        for (tf::mesh& operand : pair)
            for (std::uint64_t parts = 1 + source.below(4); parts > 0; --parts)
                operand = together(operand, random_part(source));
        const tf::fill_rule rule = rules[source.below(rules.size())];
        const std::string text = formulas[source.below(formulas.size())];
        check_same_boolean(tf::boolean({pair[0], pair[1]}, {text, 2}, {.fill_rule = rule}),
                           test::whole_boolean({pair[0], pair[1]}, text, {.fill_rule = rule}));
    }
}

TEST_CASE(
    "manifold operands: boxes on a lattice, that touch in every way, give the general result") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        operands pair{inside_out(test::lattice_box(source)), test::lattice_box(source)};
        if (source.below(2) == 0) std::swap(pair[0], pair[1]);
        for (const tf::fill_rule rule : rules)
            for (const std::string text : formulas)
                check_same_boolean(
                    tf::boolean({pair[0], pair[1]}, {text, 2}, {.fill_rule = rule}),
                    test::whole_boolean({pair[0], pair[1]}, text, {.fill_rule = rule}));
    }
}

TEST_CASE("manifold operands: the same bytes on any number of threads, and progress can say stop") {
    const operands pair{together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02})),
                        moved(together(ball(5, 1.0), ball(4, 0.5)), {0.4, 0.3, 0.2})};
    const tf::boolean_result all = tf::difference(pair[0], pair[1]);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::boolean_result result = tf::difference(pair[0], pair[1]);
        CHECK(result.mesh == all.mesh);
        CHECK(result.face_source == all.face_source);
        CHECK(result.vertex_source == all.vertex_source);
    }
    for (const double limit : {0.0, 0.3, 0.65, 0.75, 0.85}) {
        const tf::boolean_result stopped = tf::difference(
            pair[0], pair[1], {.progress = [&](double done) { return done < limit; }});
        CHECK(stopped.certificate.status == tf::status::cancelled);
        CHECK(stopped.mesh.faces.empty());
    }
}

TEST_CASE("manifold operands: with volumes, and in float32") {
    const operands pair{together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02})),
                        moved(ball(4, 1.0), {0.4, 0.3, 0.2})};
    const tf::boolean_result with_volumes = tf::unite(pair[0], pair[1], {.volumes = true});
    CHECK(with_volumes.volumes);
    CHECK(with_volumes.mesh == tf::unite(pair[0], pair[1]).mesh);
    CHECK(tf::unite(pair[0], pair[1], {.precision = tf::precision::float32}).certificate);
}
