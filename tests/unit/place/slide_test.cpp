#include <libmesh/base/max_displacement.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/own_folder.hpp>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>
#include <support/still_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::still_parts;
using tf::mesh_relation;
using tf::placement_outcome;
using tf::prepared_mesh;

const tf::point3 down{0.0, 0.0, -1.0};

double lowest(const std::vector<tf::point3>& points) {
    double z = std::numeric_limits<double>::infinity();
    for (const tf::point3& p : points) z = std::min(z, p.z);
    return z;
}

}  // namespace

TEST_CASE("slide: the first of several ends it, what is beside the way is not indexed") {
    const prepared_mesh a(moved(box(6, 1, 1), {0, 0, 9}));
    still_parts among;
    among.add(box(1, 1, 2));
    among.add(moved(box(1, 1, 3), {2, 0, 0}));
    among.add(moved(box(1, 1, 3), {4, 0, 0}));
    among.add(moved(box(1, 1, 8), {9, 0, 0}));  // beside it
    for (const double clearance : {0.0, 0.25}) {
        const auto found = tf::slide(a, among.prepared, {0, 0, -3}, {.clearance = clearance});
        REQUIRE(found);
        CHECK(found.certificate.status == tf::status::ok);
        CHECK(found.outcome == placement_outcome::contact);
        CHECK(found.travel == 6.0 - clearance);
        CHECK(found.direction == down);
        CHECK(found.points == moved(box(6, 1, 1), {0, 0, 3.0 + clearance}).points);
        CHECK(found.relation_at_start ==
              (clearance > 0.0 ? mesh_relation::clear : mesh_relation::disjoint));
        CHECK(found.relation == (clearance > 0.0 ? mesh_relation::clear : mesh_relation::touching));
        for (const auto& c : found.contacts) {
            CHECK((c.fixed == 1 || c.fixed == 2));
            CHECK(c.point.z == 3.0);
        }
        const auto faces_up = [](const auto& c) { return c.normal == tf::point3{0, 0, 1}; };
        CHECK(std::any_of(found.contacts.begin(), found.contacts.end(), faces_up));
        CHECK(found.contact_count > 0);
        CHECK(found.statistics.fixed_culled == 1);
    }
    CHECK(among.prepared[3].indexes_built() == 0);
    CHECK(among.prepared[1].indexes_built() > 0);
    const std::uint64_t built = among.prepared[1].indexes_built();
    const auto beyond = tf::slide(a, among.prepared, down, {.max_travel = 5.0});
    CHECK(beyond.outcome == placement_outcome::nothing_met);
    CHECK(beyond.points == moved(box(6, 1, 1), {0, 0, 9}).points);
    CHECK(among.prepared[1].indexes_built() == built);
}

TEST_CASE("slide: what touches stays, what penetrates or is too near has no place") {
    const tf::mesh floor = box(4, 4, 1);
    const tf::mesh on = moved(box(1, 1, 1), {1, 1, 1});
    const auto stays = tf::slide(on, floor, down);
    CHECK(stays.outcome == placement_outcome::unchanged);
    CHECK(stays.points == on.points);
    CHECK(stays.relation == mesh_relation::touching);
    CHECK(stays.contact_count > 0);
    CHECK(tf::slide(on, floor, down, {.clearance = 0.5}).outcome ==
          placement_outcome::starts_touching);
    const auto in = tf::slide(moved(on, {0, 0, -0.5}), floor, down);
    CHECK(in.outcome == placement_outcome::starts_penetrating);
    CHECK(in.certificate.status == tf::status::no_placement);
    CHECK(in.moved(on).mesh.points.empty());
    CHECK_THROWS_WITH_AS((void)in.moved(on).value(), "penetrates a fixed mesh at the start",
                         tf::not_certified_error);
    CHECK(tf::slide(moved(on, {0, 0, 0.25}), floor, down, {.clearance = 0.5}).outcome ==
          placement_outcome::starts_too_near);
    CHECK(tf::slide(on, tf::mesh{}, down).outcome == placement_outcome::nothing_met);
    CHECK(tf::slide(tf::mesh{}, floor, down).outcome == placement_outcome::nothing_met);
}

TEST_CASE("slide: an unjoined box inside of another is found to penetrate it") {
    const tf::mesh big = test::unjoined(box(10, 10, 10));
    const tf::mesh small = moved(test::unjoined(box(1, 1, 1)), {5, 5, 5});
    CHECK(tf::slide(small, big, down).outcome == placement_outcome::starts_penetrating);
    CHECK(tf::slide(small, big, down, {.vertices = tf::vertex_identity::by_index}).outcome ==
          placement_outcome::contact);
}

TEST_CASE("slide: what is returned does not penetrate, and keeps the clearance") {
    test::random source(8);
    std::size_t stepped_back = 0;
    for (int round = 0; round < 40; ++round) {
        const double far = round % 2 == 0 ? 0.0 : 1e3;
        still_parts among;
        for (int i = 0; i < 3; ++i)
            among.add(moved(test::ball(2, 0.3 + source.unit()),
                            {source.in(-1, 1) + far, source.in(-1, 1), source.in(-0.5, 0.5)}));
        const bool single = round % 4 < 2;
        const double clearance = round % 3 == 0 ? 0.125 : 0.0;
        const tf::mesh a = moved(test::ball(2, 0.5), {far, 0, 5});
        const tf::point3 motion{source.in(-0.05, 0.05), 0, -1};
        const auto found =
            tf::slide(prepared_mesh::borrow(a), among.prepared, motion,
                      {.clearance = clearance,
                       .precision = single ? tf::precision::float32 : tf::precision::float64});
        REQUIRE(found);
        CHECK(found.outcome == placement_outcome::contact);
        CHECK(found.certificate.precision ==
              (single ? tf::precision::float32 : tf::precision::float64));
        CHECK(found.certificate.max_displacement ==
              tf::detail::max_displacement(a.points, found.matrix, found.points));
        CHECK(found.certificate.max_displacement <= (far + 8) * (single ? 0x1p-24 : 0x1p-52));
        stepped_back += found.statistics.backed_off > 0;
        double least = std::numeric_limits<double>::infinity();
        const tf::mesh there{found.points, a.faces};
        for (const tf::mesh& part : among.meshes) {
            CHECK(tf::relation(there, part).relation != tf::mesh_relation::penetrating);
            least = std::min(least, tf::closest_pair(there, part)->distance);
        }
        CHECK(least >= clearance);
        CHECK(least < clearance + 1e-2);
        for (const tf::point3& p : there.points)
            if (single) CHECK(p.z == double{static_cast<float>(p.z)});
    }
    CHECK(stepped_back > 0);
}

TEST_CASE("slide: what fell on something is close to it in the coordinates written") {
    test::random source(3);
    for (int round = 0; round < 60; ++round) {
        const double far = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 1e3 : 1e6;
        const bool single = round % 2 == 0;
        const auto in_place = [&](const tf::mesh& mesh) {
            tf::mesh there = moved(mesh, {far, -far, far});
            if (single)
                for (tf::point3& p : there.points)
                    p = {double{static_cast<float>(p.x)}, double{static_cast<float>(p.y)},
                         double{static_cast<float>(p.z)}};
            return there;
        };
        const tf::mesh b = in_place(test::ball(2, 1.0 + source.unit()));
        const tf::mesh a = in_place(moved(test::ball(2, 0.5 + source.unit()),
                                          {source.in(-0.5, 0.5), source.in(-0.5, 0.5), 4.0}));
        const tf::point3 motion{source.in(-0.1, 0.1), source.in(-0.1, 0.1), -1.0};
        const auto contact = tf::time_of_impact(a, b, motion);
        REQUIRE(contact.outcome == tf::placement_outcome::contact);
        const auto found = tf::slide(
            a, b, motion, {.precision = single ? tf::precision::float32 : tf::precision::float64});
        REQUIRE(found);
        CHECK(tf::relation({found.points, a.faces}, b).relation != tf::mesh_relation::penetrating);
        // a little further it would
        const double ulp = (4.0 + far) * (single ? 0x1p-23 : 0x1p-52);
        const double time = found.travel / std::hypot(motion.x, motion.y, motion.z) + 8 * ulp;
        tf::mesh further = a;
        for (tf::point3& p : further.points)
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] += time * motion[k];
                if (single) p[k] = double{static_cast<float>(p[k])};
            }
        CHECK(tf::relation(further, b).relation != tf::mesh_relation::disjoint);
    }
}

TEST_CASE("drop: on the bed exactly, from above and from below") {
    test::random source(2);
    for (int round = 0; round < 60; ++round) {
        const double bed = round % 3 == 0 ? 0.0 : source.in(-10, 10);
        const double clearance = round % 4 == 0 ? 0.5 : 0.0;
        const bool single = round % 2 == 0;
        const tf::mesh a = moved(test::ball(1, 1.0), {0, 0, source.in(-100, 100)});
        const auto found =
            tf::drop(a, {.clearance = clearance,
                         .precision = single ? tf::precision::float32 : tf::precision::float64,
                         .bed = bed});
        REQUIRE(found);
        CHECK(found.outcome == placement_outcome::bed);
        REQUIRE(found.bed);
        CHECK(*found.bed >= bed + clearance);
        CHECK(*found.bed - bed - clearance <= (single ? 1e-6 : 0.0));
        CHECK(lowest(found.points) == *found.bed);
        REQUIRE(found.contacts.size() == 1);
        CHECK_FALSE(found.contacts[0].fixed_face.has_value());
        CHECK((found.below_bed > 0.0) == (found.direction.z > 0.0));
    }
    CHECK(*tf::drop(box(1, 1, 1)).bed == 0.0);
}

TEST_CASE("drop: on what comes first, of fixed meshes and the bed") {
    const tf::mesh a = moved(box(1, 1, 1), {0, 0, 9}), step = box(1, 1, 2);
    const tf::mesh beside = moved(a, {5, 0, 0});
    CHECK(lowest(tf::drop(a, step).points) == 2.0);
    CHECK(lowest(tf::drop(a, step, {.bed = 3.0}).points) == 3.0);
    CHECK(lowest(tf::drop(beside, step, {.bed = -1.0}).points) == -1.0);
    CHECK(tf::drop(beside, step).outcome == placement_outcome::nothing_met);
    const auto below = tf::drop(a, step, {.bed = 20.0});
    CHECK(below.outcome == placement_outcome::starts_below_bed);
    CHECK(below.below_bed == 11.0);
    CHECK(tf::drop(a, {.max_travel = 4.0, .bed = 20.0}).outcome == placement_outcome::too_far);
    CHECK(tf::drop(a, {.max_travel = 4.0}).outcome == placement_outcome::nothing_met);
}

TEST_CASE("slide and drop: what cannot be meant is refused, and named") {
    const tf::mesh a = moved(box(1, 1, 1), {0, 0, 5}), b = box(1, 1, 1);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const tf::point3& d : {tf::point3{}, tf::point3{0, std::nan(""), 0}})
        CHECK_THROWS_WITH_AS(static_cast<void>(tf::slide(a, b, d)),
                             "treeform::slide: the direction is zero or not finite",
                             std::invalid_argument);
    for (const double c : {-1.0, infinity, std::nan("")})
        CHECK_THROWS_AS(static_cast<void>(tf::slide(a, b, down, {.clearance = c})),
                        std::invalid_argument);
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::drop(a, {.bed = 0.0}, {0, 0, 1})),
                         "treeform::drop: the direction does not lead down to the bed",
                         std::invalid_argument);
    CHECK_THROWS_AS(
        static_cast<void>(tf::drop(a, {.precision = tf::precision::float32, .bed = 1e300})),
        std::invalid_argument);
    still_parts among;
    among.add(b);
    among.add(b);
    among.meshes[1].faces[5][2] = 77;
    CHECK_THROWS_WITH_AS(
        static_cast<void>(tf::slide(prepared_mesh::borrow(a), among.prepared, down)),
        doctest::Contains("treeform::slide: fixed 1: face 5 has a corner out of range"),
        std::invalid_argument);
    const tf::mesh huge = moved(a, {1e300, 0, 0});
    const auto out = tf::drop(huge, {.precision = tf::precision::float32});
    CHECK(out.certificate.status == tf::status::out_of_range);
    CHECK(out.points == huge.points);
    CHECK_FALSE(out);
    CHECK(out.certificate.precision == tf::precision::float32);
    CHECK(out.certificate.max_displacement == 0.0);  // of points that stay where they are
}

TEST_CASE("slide: clouds move, and stand still") {
    const std::vector<tf::point3> points{{0.25, 0.5, 4}, {0.5, 0.25, 5}};
    const prepared_mesh cloud = prepared_mesh::borrow({points});
    const prepared_mesh floor(box(1, 1, 1));
    const auto down_to_floor = tf::slide(cloud, floor, down);
    CHECK(down_to_floor.points == std::vector<tf::point3>{{0.25, 0.5, 1}, {0.5, 0.25, 2}});
    CHECK(down_to_floor.contacts[0].moving == 0);
    const auto up_to_cloud = tf::slide(floor, cloud, {0, 0, 1});
    CHECK(up_to_cloud.points == moved(box(1, 1, 1), {0, 0, 3}).points);
}

TEST_CASE(
    "a fixed mesh that is inside out has contacts with the same normals, and is left the same "
    "way") {
    const prepared_mesh a(moved(box(1, 1, 1), {0.5, 0.5, 0.75}));
    const prepared_mesh floor(box(2, 2, 1)), turned(test::inside_out(box(2, 2, 1)));
    const auto at = tf::measure_in_place(a, floor), same = tf::measure_in_place(a, turned);
    REQUIRE(at.contacts.size() == same.contacts.size());
    CHECK(at.relation == tf::mesh_relation::penetrating);
    CHECK(same.relation == at.relation);
    for (std::size_t i = 0; i < at.contacts.size(); ++i)
        CHECK(same.contacts[i].normal == at.contacts[i].normal);
    CHECK(tf::separate(a, turned).travel == tf::separate(a, floor).travel);
}

TEST_CASE("a placed mesh is written in the points that were checked, or not at all") {
    const test::own_folder folder("slide_test");
    const tf::mesh part = moved(box(1, 1, 1), {0, 0, 4});
    const auto in_doubles = tf::drop(part, {.bed = 0.7});
    const auto low = in_doubles.moved(part);
    CHECK(low.value().points == in_doubles.points);
    CHECK(low.value().faces == part.faces);
    CHECK_NOTHROW(tf::write(folder.path / "low.ply", low));
    CHECK_THROWS_AS(tf::write(folder.path / "low.stl", low), tf::io_error);  // 0.7 is no float
    const auto in_floats = tf::drop(part, {.precision = tf::precision::float32, .bed = 0.7});
    CHECK(tf::write(folder.path / "low.stl", in_floats.moved(part)).max_displacement == 0.0);
    CHECK_THROWS_AS((void)in_floats.moved(tf::mesh{}), std::invalid_argument);
    const auto none = tf::slide(part, part, {0, 0, 1});  // penetrates at the start
    CHECK_THROWS_AS((void)none.moved(part).value(), tf::not_certified_error);
}

TEST_CASE("contacts are classified as the faces lie at the place") {
    const prepared_mesh floor(box(4, 4, 1));
    const auto relations_at = [&](double z, double clearance) {
        const prepared_mesh a(moved(box(1, 1, 1), {1.25, 1.5, z}));
        const auto at = tf::measure_in_place(a, floor, {.clearance = clearance});
        const auto found = at.face_relations(a, floor);
        std::array<std::set<tf::mesh_relation>, 2> others;
        for (std::size_t i = 0; i < 2; ++i)
            for (const tf::mesh_relation how : found[i])
                if (how != tf::mesh_relation::disjoint) others[i].insert(how);
        CHECK(others[0] == others[1]);
        return others[0];
    };
    using tf::mesh_relation;
    CHECK(relations_at(3.0, 0.0).empty());
    CHECK(relations_at(1.0, 0.0) == std::set{mesh_relation::touching});
    CHECK(relations_at(0.5, 0.0) == std::set{mesh_relation::penetrating});
    CHECK(relations_at(1.5, 0.75) == std::set{mesh_relation::closer_than_clearance});
}
