#include <libmesh/boolean/manifold_pair.hpp>
#include <libmesh/boolean/sound_operand.hpp>
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
#include <support/was_mended.hpp>

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
using kind = tf::detail::boolean::examined_operand::kind;

kind kind_of(const tf::mesh& mesh) {
    return tf::detail::boolean::examine_operand(tf::prepared_mesh::borrow(mesh), {}).is;
}

/// The general way, in which all faces are cut: volumes take it.
tf::boolean_result evaluate_all_faces(const operands& pair, const std::string& text,
                                      tf::fill_rule rule) {
    return tf::boolean({pair[0], pair[1]}, {text, 2}, {.inside = rule, .volumes = true});
}

constexpr std::array rules{tf::fill_rule::nonzero, tf::fill_rule::odd, tf::fill_rule::positive};
constexpr std::array formulas{"a+b", "a*b", "a-b", "b-a", "a^b", "a", "b"};

/// The results of both ways are one, for all formulas and rules, and only what is near is looked at.
void check_both_ways(const operands& pair) {
    for (const tf::fill_rule rule : rules)
        for (const std::string text : formulas) {
            CAPTURE(text);
            CAPTURE(static_cast<int>(rule));
            const tf::boolean_result general = evaluate_all_faces(pair, text, rule);
            const tf::boolean_result result =
                tf::boolean({pair[0], pair[1]}, {text, 2}, {.inside = rule});
            REQUIRE(general.certificate);
            // At edges of four faces it may not be told from what is near which side is inside.
            if (!test::was_mended(general.statistics) && rule != tf::fill_rule::odd &&
                text != "a^b")
                CHECK(result.statistics.cells == 0);
            check_same_boolean(result, general);
        }
}

/// Of one operand alone, too.
void check_alone(const tf::mesh& mesh) {
    for (const tf::fill_rule rule : rules) {
        CAPTURE(static_cast<int>(rule));
        const tf::boolean_result general = evaluate_all_faces({mesh, tf::mesh{}}, "a", rule);
        const tf::boolean_result result = tf::boolean({mesh}, {"a", 1}, {.inside = rule});
        if (!test::was_mended(general.statistics) && rule != tf::fill_rule::odd)
            CHECK(result.statistics.cells == 0);
        check_same_boolean(result, general);
        CHECK(
            tf::resolve_self_intersections(mesh, tf::resolve_mode::outer, {.inside = rule}).mesh ==
            general.mesh);
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
    CHECK(kind_of(ball(3, 1.0)) == kind::sound);
    CHECK(kind_of(inside_out(ball(3, 1.0))) == kind::manifold);
    CHECK(kind_of(together(ball(3, 1.0), ball(3, 0.5))) == kind::manifold);  // winds twice
    CHECK(kind_of(together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02}))) == kind::manifold);
    CHECK(kind_of(together(ball(2, 1.0), moved(ball(2, 1.0), {0.1, 0.2, 0.3}))) == kind::unknown);
    tf::mesh open = ball(3, 1.0);
    open.faces.pop_back();
    CHECK(kind_of(open) == kind::unknown);
    const tf::mesh twice = together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02}));
    const auto prepared = tf::prepared_mesh::borrow(twice);
    CHECK(tf::detail::boolean::examine_operand(prepared, {}).pairs ==
          tf::self_intersections(twice, {.vertices = tf::vertex_identity::by_index}).pairs);
}

TEST_CASE("manifold operands: parts that cross, nest, or are inside out give the general result") {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
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
        REQUIRE(kind_of(a) == kind::manifold);
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
    std::size_t compared = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        operands pair;
        for (tf::mesh& operand : pair)
            for (std::uint64_t parts = 1 + source.below(4); parts > 0; --parts)
                operand = together(operand, random_part(source));
        const tf::fill_rule rule = rules[source.below(rules.size())];
        const std::string text = formulas[source.below(formulas.size())];
        const tf::boolean_result general = evaluate_all_faces(pair, text, rule);
        REQUIRE(general.certificate);
        std::array<std::vector<tf::face_pair>, 2> own;
        for (std::size_t k = 0; k < 2; ++k)
            own[k] =
                tf::self_intersections(pair[k], {.vertices = tf::vertex_identity::by_index}).pairs;
        const auto a = tf::prepared_mesh::borrow(pair[0]), b = tf::prepared_mesh::borrow(pair[1]);
        const auto made = tf::detail::boolean::boolean_of_manifold_pair(
            {&a, &b}, {own[0], own[1]}, true, {text, 2}, {.inside = rule});
        if (!made) {
            ++refused;
            continue;
        }
        if (!made->is_manifold) continue;  // the general result was split
        ++compared;
        check_same_boolean(made->result, general);
    }
    CHECK(compared > 110);
    CHECK(refused < 10);
}

TEST_CASE(
    "manifold operands: boxes on a lattice, that touch in every way, give the general result") {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        operands pair{inside_out(test::lattice_box(source)), test::lattice_box(source)};
        if (source.below(2) == 0) std::swap(pair[0], pair[1]);
        REQUIRE(kind_of(pair[source.below(2)]) != kind::unknown);
        for (const tf::fill_rule rule : rules)
            for (const std::string text : formulas)
                check_same_boolean(tf::boolean({pair[0], pair[1]}, {text, 2}, {.inside = rule}),
                                   evaluate_all_faces(pair, text, rule));
    }
}

TEST_CASE("manifold operands: the same bytes on any number of threads, and progress can say stop") {
    const operands pair{together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02})),
                        moved(together(ball(5, 1.0), ball(4, 0.5)), {0.4, 0.3, 0.2})};
    const tf::boolean_result all = tf::subtract(pair[0], pair[1]);
    CHECK(all.statistics.cells == 0);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const tf::boolean_result result = tf::subtract(pair[0], pair[1]);
        CHECK(result.mesh == all.mesh);
        CHECK(result.face_source == all.face_source);
        CHECK(result.vertex_source == all.vertex_source);
    }
    for (const double limit : {0.0, 0.3, 0.65, 0.75, 0.85}) {
        const tf::boolean_result stopped =
            tf::subtract(pair[0], pair[1], {.progress = [&](double done) { return done < limit; }});
        CHECK(stopped.certificate.status == tf::status::cancelled);
        CHECK(stopped.mesh.faces.empty());
    }
}

TEST_CASE("manifold operands: volumes and float32 are found the general way") {
    const operands pair{together(ball(5, 1.0), moved(ball(1, 0.1), {1, 0.01, 0.02})),
                        moved(ball(4, 1.0), {0.4, 0.3, 0.2})};
    const tf::boolean_result with_volumes = tf::unite(pair[0], pair[1], {.volumes = true});
    CHECK(with_volumes.volumes);
    CHECK(with_volumes.mesh == tf::unite(pair[0], pair[1]).mesh);
    CHECK(tf::unite(pair[0], pair[1], {.precision = tf::precision::float32}).certificate);
}
