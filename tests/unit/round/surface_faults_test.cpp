#include <libmesh/round/surface_faults.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

using bytes = std::vector<std::uint8_t>;

/// As many faces as may be called certified: none is degenerate, no two of them meet.
bytes certified_faces(const tf::mesh& mesh, const std::vector<tf::face_pair>& pairs) {
    bytes certified(mesh.faces.size(), 1);
    for (const std::uint32_t f : tf::find_invalid_faces(mesh).degenerate_faces) certified[f] = 0;
    for (const tf::face_pair& pair : pairs)
        if (certified[pair.a] != 0) certified[pair.b] = 0;
    return certified;
}

}  // namespace

TEST_CASE("faults: of a surface of which nothing is known, all are found") {
    tf::mesh two =
        test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {0.5, 0.5, 0.5}));
    CHECK(tf::detail::round::find_faults(two, {}).pairs == tf::self_intersections(two).pairs);
    CHECK_FALSE(tf::detail::round::find_faults(two, {}).open);
    two.faces.pop_back();
    CHECK(tf::detail::round::find_faults(two, {}).open);
    CHECK_FALSE(tf::detail::round::find_faults(two, {.solid = false}).open);
    CHECK(tf::detail::round::find_faults({}, {}).pairs.empty());
}

TEST_CASE("faults: what is certified is not looked at, and all else is found against everything") {
    std::size_t doubted = 0, met = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh mesh = test::ball(4, 1.0);  // and small faces across it, here and there
        for (int i = 0; i < 40; ++i) {
            const auto first = static_cast<std::uint32_t>(mesh.points.size());
            const tf::point3 at = mesh.points[source.below(500)];
            for (int k = 0; k < 3; ++k)
                mesh.points.push_back({at.x + source.in(-0.1, 0.1), at.y + source.in(-0.1, 0.1),
                                       at.z + source.in(-0.1, 0.1)});
            mesh.faces.push_back({first, first + 1, first + 2});
        }
        mesh.faces.push_back({0, 1, 1});
        const auto pairs = tf::self_intersections(mesh).pairs;
        const bytes certified = certified_faces(mesh, pairs);
        for (const std::uint8_t s : certified) doubted += s == 0 ? 1 : 0;
        for (const unsigned threads : {1U, 2U, 8U}) {
            const tf::thread_scope scope(threads);
            const auto found =
                tf::detail::round::find_faults(mesh, {.certified = certified, .solid = false});
            CHECK(found.pairs == pairs);
            CHECK(found.degenerate == tf::find_invalid_faces(mesh).degenerate_faces);
        }
        met += pairs.size();
    }
    CHECK(doubted > 100);
    CHECK(met > 1000);
}

TEST_CASE("faults: are found in soups of any size and place, flat ones, and among large faces") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh mesh = test::random_soup(source, 400, seed % 2 == 0 ? 0.02 : 0.05);
        if (seed % 4 == 3)  // large ones
            for (tf::face& f : mesh.faces)
                if (source.below(20) == 0) f[2] = mesh.faces[source.below(400)][2];
        const std::array<double, 5> scales{1.0, 0x1p-600, 0x1p190, 0x1p600, 0x1p-1040};
        const double scale = scales[seed % 5];
        for (tf::point3& p : mesh.points) {
            if (seed % 3 == 1) p.z = 0.0;
            p = {(p.x + static_cast<double>(seed % 7)) * scale, p.y * scale, p.z * scale};
        }
        const auto pairs = tf::self_intersections(mesh).pairs;
        const bytes certified = certified_faces(mesh, pairs);
        CHECK(
            tf::detail::round::find_faults(mesh, {.certified = certified, .solid = false}).pairs ==
            pairs);
    }
}

TEST_CASE("faults: edges of faces that are not certified are looked at, and no others") {
    tf::mesh mesh = test::ball(3, 1.0);
    const tf::face hole = mesh.faces[100];
    mesh.faces.erase(mesh.faces.begin() + 100);
    bytes certified(mesh.faces.size(), 1);
    CHECK_FALSE(tf::detail::round::find_faults(mesh, {.certified = certified}).open);
    certified[0] = 0;  // not at the hole
    const auto shared = [&](std::size_t f) {
        std::size_t count = 0;
        for (const std::uint32_t p : mesh.faces[f])
            for (const std::uint32_t q : hole) count += p == q ? 1 : 0;
        return count;
    };
    REQUIRE(shared(0) < 2);
    CHECK_FALSE(tf::detail::round::find_faults(mesh, {.certified = certified}).open);
    CHECK_FALSE(tf::detail::round::find_faults(
                    mesh, {.certified = bytes(certified.size(), 0), .solid = false})
                    .open);
    CHECK(tf::detail::round::find_faults(mesh, {.certified = bytes(certified.size(), 0)}).open);
    std::size_t beside = 0;
    while (shared(beside) != 2) ++beside;
    certified[beside] = 0;
    CHECK(tf::detail::round::find_faults(mesh, {.certified = certified}).open);
}

TEST_CASE("faults: parts that are turned inside out, or outside, are found where they have moved") {
    const tf::mesh ball = test::ball(3, 1.0);
    const tf::mesh small = test::moved(test::box(0.1, 0.1, 0.1), {-0.05, -0.05, -0.05});
    const tf::mesh outside = test::moved(small, {3, 0, 0});
    struct shells {
        tf::mesh mesh;        ///< of the ball, then a box
        bool ball_is_turned;  ///< has the outside behind its faces
        bool box_is_turned;
    };
    const std::vector<shells> all{{test::together(ball, outside), false, false},
                                  {test::together(ball, test::inside_out(outside)), false, true},
                                  {test::together(ball, test::inside_out(small)), false, false},
                                  {test::together(ball, small), false, true},
                                  {test::together(test::inside_out(ball), outside), true, false}};
    for (const shells& s : all) {
        const std::size_t of_ball = ball.faces.size();
        std::vector<std::uint32_t> expected;
        for (std::uint32_t f = 0; f < s.mesh.faces.size(); ++f)
            if (f < of_ball ? s.ball_is_turned : s.box_is_turned) expected.push_back(f);
        CHECK(tf::detail::round::find_faults(s.mesh, {}).turned == expected);
        bytes certified(s.mesh.faces.size(), 1);
        CHECK(tf::detail::round::find_faults(s.mesh, {.certified = certified}).turned.empty());
        for (std::size_t f = of_ball; f < certified.size(); ++f) certified[f] = 0;
        if (s.ball_is_turned) expected.clear();  // it was so before
        CHECK(tf::detail::round::find_faults(s.mesh, {.certified = certified}).turned == expected);
        CHECK(tf::detail::round::find_faults(s.mesh, {.certified = certified, .solid = false})
                  .turned.empty());
        // Of the ball some faces have moved: the others say what is inside.
        certified.assign(certified.size(), 1);
        certified[0] = certified[7] = 0;
        CHECK(tf::detail::round::find_faults(s.mesh, {.certified = certified}).turned.empty());
    }
}
