/// \file
/// Repair merges coplanar faces that were cut, and still knows what is left of each face.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/repaired.hpp>
#include <support/rooms.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

constexpr auto to_float = tf::precision::float32;

/// Boards that overlap, all from 0 to 1 in height, so that tops lie on tops, turned any way else.
tf::mesh boards(std::size_t count) {
    test::random source(5);
    tf::mesh all;
    for (std::size_t i = 0; i < count; ++i) {
        tf::mesh board = test::box(source.in(2.0, 6.0), source.in(0.2, 0.6), 1.0);
        const double turn = source.in(0.0, 3.0), x = source.in(0.0, 4.0), y = source.in(0.0, 4.0);
        for (tf::point3& p : board.points)
            p = {x + std::cos(turn) * p.x - std::sin(turn) * p.y,
                 y + std::sin(turn) * p.x + std::cos(turn) * p.y, p.z};
        all = test::together(std::move(all), board);
    }
    return all;
}

/// The area of the faces that fill holes.
double area_filled(const tf::repair_result& made) {
    tf::mesh filling{made.mesh.points, {}};
    for (std::size_t f = 0; f < made.face_source.size(); ++f)
        if (made.face_source[f] == tf::repair_result::none)
            filling.faces.push_back(made.mesh.faces[f]);
    return tf::surface_area(filling);
}

/// What `mesh` becomes with its cuts and without them is the same, and of the same faces.
void check_same(const tf::mesh& mesh, tf::repair_options options) {
    const tf::repair_result merged = tf::repair(mesh, options);
    options.keep_cuts = true;
    const tf::repair_result as_cut = tf::repair(mesh, options);
    REQUIRE_MESSAGE(merged.certificate, merged.certificate.message());
    REQUIRE_MESSAGE(as_cut.certificate, as_cut.certificate.message());
    CHECK(merged.mesh.faces.size() <= as_cut.mesh.faces.size());
    CHECK(tf::signed_volume(merged.mesh) == doctest::Approx(tf::signed_volume(as_cut.mesh)));
    CHECK(area_filled(merged) == doctest::Approx(area_filled(as_cut)));
    CHECK(merged.is_kept == as_cut.is_kept);
    CHECK(merged.statistics.removed == as_cut.statistics.removed);
    CHECK(merged.statistics.dropped_shells == as_cut.statistics.dropped_shells);
    CHECK(merged.statistics.vanished_components == as_cut.statistics.vanished_components);
    CHECK(merged.statistics.area_lost == doctest::Approx(as_cut.statistics.area_lost));
    for (const std::uint32_t f : merged.face_source)
        if (f != tf::repair_result::none) CHECK(merged.is_kept[f] == 1);
}

}  // namespace

TEST_CASE(
    "repair: tops of boards that overlap are one, in floats, and nothing is said to be lost") {
    const tf::mesh dirty = boards(40);
    const tf::repair_result made = tf::repair(dirty, {.detach = false, .precision = to_float});
    REQUIRE_MESSAGE(made.certificate, made.certificate.message());
    const auto joined = tf::unite(dirty, tf::mesh{}, {.precision = to_float});
    REQUIRE(joined.certificate);
    CHECK(made.mesh.faces.size() == joined.mesh.faces.size());
    const tf::repair_result as_cut =
        tf::repair(dirty, {.detach = false, .precision = to_float, .keep_cuts = true});
    CHECK(as_cut.mesh.faces.size() > 2 * made.mesh.faces.size());
    CHECK(made.statistics.vanished_components == 0);
    CHECK(made.statistics.dropped_shells == 0);
    CHECK(made.statistics.area_lost == 0.0);
    check_same(dirty, {});
    // A face that is none of the lowest is left, too.
    CHECK(std::ranges::count(made.is_kept, 1) >
          static_cast<std::ptrdiff_t>(dirty.faces.size() / 2));
}

TEST_CASE("repair: of boxes on a lattice, the same is left, merged or not") {
    test::random source(7);
    for (int heap = 0; heap < 60; ++heap) {
        CAPTURE(heap);
        const std::size_t boxes = 2 + source.below(20);
        tf::mesh all;
        for (std::size_t i = 0; i < boxes; ++i)
            all = test::together(std::move(all), test::lattice_box(source));
        check_same(all, {.precision = heap % 2 == 0 ? to_float : tf::precision::float64});
    }
}

TEST_CASE("repair: of labeled rooms, the same is left, merged or not") {
    // With boards through them, flush with their roof.
    tf::mesh dirty = test::rooms(3, 3, 2);
    for (const double x : {0.5, 1.25})
        dirty = test::together(dirty, test::moved(test::box(1, 4, 1), {x, -0.5, 1}));
    check_same(dirty, {});
    const tf::repair_result made = tf::repair(dirty);
    CHECK(made.statistics.labeled_cells > 18);
    CHECK(made.mesh.faces.size() < tf::repair(dirty, {.keep_cuts = true}).mesh.faces.size());
}

TEST_CASE("repair: what fills a hole is not merged with what is beside it") {
    tf::mesh dirty = test::box(2, 2, 1);
    dirty.faces.erase(dirty.faces.begin() + 2);  // half of the top
    dirty = test::together(dirty, test::moved(test::box(2, 2, 1), {0.5, 0.25, 0}));
    check_same(dirty, {});
    const tf::repair_result made = tf::repair(dirty);
    CHECK(made.statistics.holes == 1);
    CHECK(area_filled(made) > 0.0);
}

TEST_CASE("repair: what is too thin for floats is a loss, also where its faces were merged") {
    const auto slab = [](double x) {
        return test::moved(test::box(40, 10, 0x1p-20), {x, 0.0, 1000.0});
    };
    const tf::mesh dirty =
        test::together(test::box(10, 10, 10), test::together(slab(0.0), slab(20.0)));
    for (const bool keep_cuts : {false, true}) {
        const tf::repair_result made =
            tf::repair(dirty, {.precision = to_float, .keep_cuts = keep_cuts});
        CHECK(made.certificate.status == tf::status::excessive_loss);
        CHECK(std::ranges::count(made.is_kept, 1) == 12);
        CHECK(made.statistics.vanished_components == 2);
        const tf::repair_result resolved = tf::resolve_self_intersections(
            dirty, tf::resolve_mode::outer, {.precision = to_float, .keep_cuts = keep_cuts});
        CHECK(resolved.statistics.vanished_components == 2);
        CHECK(resolved.statistics.removed == 24);
    }
}

TEST_CASE("resolve: outer merges what was cut, split does not") {
    const tf::mesh pair =
        test::together(test::box(2, 1, 1), test::moved(test::box(2, 1, 1), {1, 0, 0}));
    using enum tf::resolve_mode;
    const tf::repair_result merged = tf::resolve_self_intersections(pair, outer);
    const tf::repair_result as_cut =
        tf::resolve_self_intersections(pair, outer, {.keep_cuts = true});
    CHECK(merged.mesh.faces.size() == 12);
    CHECK(as_cut.mesh.faces.size() > 12);
    CHECK(merged.statistics.removed == as_cut.statistics.removed);
    CHECK(merged.statistics.vanished_components == 0);
    const tf::repair_result all = tf::resolve_self_intersections(pair, split);
    CHECK(all.mesh == tf::resolve_self_intersections(pair, split, {.keep_cuts = true}).mesh);
    CHECK(all.mesh.faces.size() > as_cut.mesh.faces.size());
}
