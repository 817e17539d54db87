/// \file
/// `repair` where faces disagree: cells labeled inside or outside with the least disagreement.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/rooms.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace {

void require_volume(const tf::repair_result& result, double volume) {
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    const tf::mesh joined = tf::weld(result.mesh).mesh;
    CHECK(tf::count_topology(joined.points.size(), joined.faces).closed_manifold);
    CHECK(tf::signed_volume(result.mesh) == doctest::Approx(volume));
}

void turn_some(tf::mesh& mesh, test::random& source, std::size_t one_in) {
    for (tf::face& f : mesh.faces)
        if (source.below(one_in) == 0) std::swap(f[1], f[2]);
}

/// A Moebius strip of 20 squares.
tf::mesh one_sided_strip() {
    tf::mesh mesh;
    for (std::uint32_t i = 0; i < 20; ++i) {
        const double turn = 6.283185307179586 * i / 20.0;
        for (const double side : {-0.3, 0.3}) {
            const double out = 1.0 + side * std::cos(turn / 2.0);
            mesh.points.push_back(
                {out * std::cos(turn), out * std::sin(turn), side * std::sin(turn / 2.0)});
        }
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * i + 1;
        const std::uint32_t c = i < 19 ? a + 2 : 1, d = i < 19 ? b + 2 : 0;
        mesh.faces.push_back({a, c, d});
        mesh.faces.push_back({a, d, b});
    }
    return mesh;
}

}  // namespace

TEST_CASE("labels: rooms with one wall between two are one solid") {
    for (const auto& [x, y, z] :
         {std::array{2U, 2U, 1U}, {3U, 3U, 1U}, {2U, 2U, 2U}, {4U, 3U, 5U}}) {
        const tf::repair_result made = tf::repair(test::rooms(x, y, z));
        require_volume(made, x * y * z);
        CHECK(made.statistics.labeled_cells == x * y * z);
        const double walls = (x - 1.0) * y * z + x * (y - 1.0) * z + x * y * (z - 1.0);
        CHECK(made.statistics.dropped_area == doctest::Approx(walls));
        CHECK(made.statistics.flipped_area == 0.0);
        CHECK(made.statistics.area_lost == 0.0);
        for (const std::uint32_t f : made.face_source) CHECK(f != tf::repair_result::none);
    }
}

TEST_CASE("labels: outer walls are outward, however they and inner ones are turned") {
    test::random source(21);
    for (int round = 0; round < 10; ++round) {
        tf::mesh dirty = test::rooms(4, 3, 1);
        turn_some(dirty, source, 2);
        require_volume(tf::repair(dirty), 12.0);
    }
}

TEST_CASE("labels: a wall that is missing, and one that ends somewhere") {
    tf::mesh dirty = test::rooms(3, 3, 1);
    const auto is_inner = [&](const tf::face& f) {  // between the first room and the next along x
        return std::ranges::all_of(f, [&](std::uint32_t p) {
            return dirty.points[p].x == 1.0 && dirty.points[p].y <= 1.0;
        });
    };
    CHECK(std::erase_if(dirty.faces, is_inner) == 2);
    require_volume(tf::repair(dirty), 9.0);

    dirty = test::box(2, 1, 1);
    // From the edge at x = 0, y = 0 inward: it bounds nothing.
    const auto first = static_cast<std::uint32_t>(dirty.points.size());
    dirty.points.insert(dirty.points.end(), {{0.5, 0.5, 0.25}, {0.5, 0.5, 0.75}});
    std::array<std::uint32_t, 2> edge{};
    for (std::uint32_t p = 0; p < first; ++p)
        if (dirty.points[p].x == 0.0 && dirty.points[p].y == 0.0)
            edge[dirty.points[p].z > 0.0 ? 1 : 0] = p;
    dirty.faces.push_back({edge[0], edge[1], first + 1});
    dirty.faces.push_back({edge[0], first + 1, first});
    require_volume(tf::repair(dirty), 2.0);
}

TEST_CASE("labels: rooms with a hole in the roof are closed by a guess") {
    tf::mesh dirty = test::rooms(3, 3, 1);
    const auto is_roof = [&](const tf::face& f) {  // of the room in the middle
        return std::ranges::all_of(f, [&](std::uint32_t p) {
            const auto& [x, y, z] = dirty.points[p];
            return z == 1.0 && x >= 1.0 && x <= 2.0 && y >= 1.0 && y <= 2.0;
        });
    };
    CHECK(std::erase_if(dirty.faces, is_roof) == 2);
    const tf::repair_result made = tf::repair(dirty);
    REQUIRE_MESSAGE(made.certificate, made.certificate.message());
    CHECK(tf::signed_volume(made.mesh) > 8.0 - 1e-4);
    CHECK(tf::signed_volume(made.mesh) < 9.0 + 1e-4);
}

TEST_CASE("labels: a cavity in a room stays one") {
    tf::mesh dirty = test::rooms(2, 2, 1);
    for (tf::point3& p : dirty.points) p = {4.0 * p.x, 4.0 * p.y, 4.0 * p.z};
    // In the first room, and apart from its walls.
    const tf::mesh cavity = test::inside_out(test::moved(test::box(1, 1, 1), {1, 1, 1}));
    require_volume(tf::repair(test::together(dirty, cavity)), 4.0 * 64.0 - 1.0);
}

TEST_CASE("labels: what faces say without a doubt is not asked about") {
    const tf::mesh box = test::box(1, 1, 1);
    tf::mesh dirty = box;
    dirty.faces.insert(dirty.faces.end(), {{2, 3, 5}, {2, 5, 4}});  // a wall from edge to edge
    CHECK(tf::repair(dirty).statistics.labeled_cells == 0);
    CHECK(tf::repair(test::together(box, test::moved(box, {0.5, 0.5, 0.5})))
              .statistics.labeled_cells == 0);
}

TEST_CASE("labels: a rule that is asked for, and steps that are left out, leave them out") {
    const tf::mesh rooms = test::rooms(2, 2, 2);
    CHECK(tf::repair(rooms, {.fill_rule = tf::fill_rule::nonzero}).statistics.labeled_cells == 0);
    CHECK(tf::repair(rooms, {.fill_rule = tf::fill_rule::even_odd}).statistics.labeled_cells == 0);
    CHECK(tf::repair(rooms, {.fill = false}).statistics.labeled_cells == 0);
    CHECK(tf::repair(rooms, {.sheet = true}).statistics.labeled_cells == 0);
}

TEST_CASE("labels: sheets are no solids") {
    for (const tf::mesh& sheet : {test::grid(8), one_sided_strip()}) {
        const tf::repair_result made = tf::repair(sheet);
        CHECK(made.certificate.status == tf::status::open_input);
        CHECK(made.certificate.open_count > 0);
    }
    // Rooms that are a speck on a sheet do not make it one.
    tf::mesh sheet = test::grid(8);
    const tf::mesh rooms = test::moved(test::rooms(2, 2, 1), {3, 3, 0});
    CHECK_FALSE(tf::repair(test::together(sheet, rooms)).certificate);
}

TEST_CASE("labels: the same on any number of threads, in floats, too, and far from the origin") {
    test::random source(8);
    tf::mesh dirty = test::rooms(3, 3, 3);
    turn_some(dirty, source, 3);
    tf::repair_result one;
    {
        const tf::thread_scope alone(1);
        one = tf::repair(dirty, {.precision = tf::precision::float32});
    }
    const tf::repair_result many = tf::repair(dirty, {.precision = tf::precision::float32});
    CHECK(one.mesh == many.mesh);
    CHECK(one.face_source == many.face_source);
    require_volume(many, 27.0);
    require_volume(tf::repair(test::scaled(test::rooms(2, 2, 2), 0x1p-40)), 8 * 0x1p-120);
    require_volume(tf::repair(test::moved(test::rooms(2, 2, 2), {0x1p30, 0, 0})), 8.0);
}

TEST_CASE("labels: progress never goes back, and can stop them") {
    const tf::mesh rooms = test::rooms(3, 3, 2);
    double last = 0.0;
    std::size_t calls = 0;
    const tf::repair_result made = tf::repair(rooms, {.progress = [&](double done) {
                                                  CHECK(done >= last);
                                                  last = done;
                                                  ++calls;
                                                  return true;
                                              }});
    REQUIRE(made.certificate);
    for (std::size_t stop = 0; stop < calls; ++stop) {
        std::size_t call = 0;
        const tf::repair_result stopped =
            tf::repair(rooms, {.progress = [&](double) { return call++ < stop; }});
        CHECK(stopped.certificate.status == tf::status::cancelled);
    }
}
