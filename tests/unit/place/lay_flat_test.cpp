#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace {

tf::transform<3> random_rotation(test::random& source) {
    double q[4], length = 0.0;
    for (double& x : q) {
        x = source.in(-1, 1);
        length += x * x;
    }
    for (double& x : q) x /= std::sqrt(length);
    const auto [w, x, y, z] = q;
    tf::transform<3> r;
    r.rows = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0},
               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0},
               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0}}};
    return r;
}

tf::mesh turned(tf::mesh mesh, const tf::transform<3>& by) {
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

double largest_of(tf::points_view points) {
    double most = 0.0;
    for (const tf::point3& p : points)
        for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(p[k]));
    return most;
}

double distance_between(const tf::point3& a, const tf::point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// What the header says of what `lay` returns.
void check_laid(const tf::mesh& mesh, const tf::laid_flat& laid,
                const tf::lay_flat_options& options) {
    REQUIRE(laid.points.size() == mesh.points.size());
    const double unit = (options.precision == tf::precision::float32) ? 0x1p-24 : 0x1p-53;
    const double largest =
        std::max({largest_of(mesh.points), largest_of(laid.points), std::abs(options.bed)});
    const tf::hull_side& side = laid.sides[laid.chosen];
    const std::vector<tf::point3>& p = mesh.points;
    const auto hull = tf::convex_hull(p);
    REQUIRE(std::count_if(hull.sides.begin(), hull.sides.end(),
                          [&](const auto& one) { return one == side; }) == 1);
    const tf::face f = hull.faces[side.first_face];
    std::size_t down = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const tf::point3& q = laid.points[i];
        const bool on_bed = tf::orient3d(p[f[0]], p[f[1]], p[f[2]], p[i]) == 0;
        down += on_bed;
        CHECK((on_bed ? q.z == laid.bed : q.z >= laid.bed));
        CHECK(std::binary_search(laid.on_bed.begin(), laid.on_bed.end(), i) == on_bed);
        CHECK(distance_between(q, laid.matrix(p[i])) <= 16 * unit * largest);
        for (std::size_t k = 0; k < 3; ++k)
            if ((options.precision == tf::precision::float32))
                CHECK(q[k] == static_cast<double>(static_cast<float>(q[k])));
    }
    CHECK(down == laid.on_bed.size());
    CHECK(down >= 3);
    CHECK(laid.corrected <= 16 * unit * largest);
    CHECK(laid);
    CHECK(laid.certificate.precision == options.precision);
    CHECK(laid.certificate.max_displacement <= 16 * unit * largest);
    CHECK(laid.certificate.max_displacement >= laid.corrected - 16 * unit * largest);
    // a rotation
    const auto& m = laid.matrix.rows;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const double d = m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
            CHECK(std::abs(d - (i == j ? 1.0 : 0.0)) < 1e-14);
        }
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    CHECK(determinant > 0.0);
    // of a center that stays
    const auto before = *tf::bounding_box(p), after = *tf::bounding_box(laid.points);
    for (std::size_t k = 0; k < 2; ++k)
        CHECK(std::abs((before.min[k] + before.max[k]) - (after.min[k] + after.max[k])) <=
              32 * unit * largest);
    if (options.keep_spin) {  // by the angle between the normal and down, no more
        const double trace = m[0][0] + m[1][1] + m[2][2];
        CHECK(trace == doctest::Approx(1.0 - 2.0 * side.normal.z).epsilon(1e-14));
    }
}

tf::mesh random_shape(test::random& source, int kind) {
    tf::mesh mesh;
    if (kind == 0) mesh = test::box(1 + source.unit(), 1 + source.unit(), 1 + source.unit());
    if (kind == 1) mesh = test::ball(2, 1.0);
    if (kind == 2) mesh = test::lattice_soup(source, 40, 30, 4);
    if (kind == 3) mesh = test::random_soup(source, 30, 0.3);
    if (kind == 4)  // a foot with pieces on it, and a recess that no side of the hull sees
        mesh = test::together(
            test::together(test::box(6, 4, 1), test::moved(test::box(1, 1, 5), {1, 1, 1})),
            test::moved(test::box(1, 1, 3), {4, 2, 1}));
    return mesh;
}

}  // namespace

TEST_CASE(
    "lay flat: a box that stands on a largest side stays, bit for bit, and comes to the bed") {
    const tf::mesh box = test::moved(test::box(3, 2, 1), {0.1, 0.2, 0.3});
    const auto laid = tf::lay_flat(box);
    REQUIRE(laid);
    CHECK(laid->sides.size() == 6);
    CHECK(laid->sides[laid->chosen].normal == tf::point3{0, 0, -1});
    for (std::size_t i = 0; i < box.points.size(); ++i) {
        CHECK(laid->points[i].x == box.points[i].x);
        CHECK(laid->points[i].y == box.points[i].y);
    }
    check_laid(box, *laid, {});
    // of the six equal sides of a cube, too
    const tf::mesh cube = test::box(1, 1, 1);
    for (const bool keep : {false, true})
        CHECK(tf::lay_flat(cube, {.keep_spin = keep})->points == cube.points);
}

TEST_CASE(
    "lay flat: a box on its edge comes down on its largest face, with its length along an axis") {
    test::random source(1);
    for (int round = 0; round < 30; ++round) {
        // Rounding has bent the box: exactly, most of its sides are two triangles.
        tf::mesh box = turned(test::box(3, 2, 1), random_rotation(source));
        const bool single = round % 2 == 0;
        if (single)
            for (tf::point3& p : box.points)
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = static_cast<double>(static_cast<float>(p[k]));
        CHECK(tf::lay_flat(box)->sides.size() > 6);
        for (const bool keep : {false, true}) {
            const tf::lay_flat_options options{
                .keep_spin = keep,
                .tolerance = 1e-6,
                .bed = 0.75,
                .precision = single ? tf::precision::float32 : tf::precision::float64};
            const auto laid = tf::lay_flat(box, options);
            REQUIRE(laid);
            REQUIRE(laid->sides.size() == 6);
            CHECK(laid->sides[laid->chosen].area == doctest::Approx(6.0).epsilon(1e-6));
            REQUIRE(laid->on_bed.size() == 4);
            CHECK(laid->corrected < 1e-6);
            for (std::size_t i = 0; i < 8; ++i) {
                const bool down = std::count(laid->on_bed.begin(), laid->on_bed.end(), i) != 0;
                CHECK(laid->points[i].z == doctest::Approx(down ? 0.75 : 1.75).epsilon(1e-6));
                if (down) CHECK(laid->points[i].z == 0.75);
            }
            if (keep) continue;
            const auto size = *tf::bounding_box(laid->points);
            const double x = size.max.x - size.min.x, y = size.max.y - size.min.y;
            CHECK(std::max(x, y) == doctest::Approx(3.0).epsilon(1e-6));
            CHECK(std::min(x, y) == doctest::Approx(2.0).epsilon(1e-6));
        }
    }
}

TEST_CASE(
    "lay flat: the side is on the bed exactly, whatever the shape, place, choice and precision") {
    test::random source(2);
    for (int round = 0; round < 100; ++round) {
        CAPTURE(round);
        tf::mesh mesh = random_shape(source, round % 5);
        if (round % 3 != 0) mesh = turned(mesh, random_rotation(source));
        const double far = round % 4 == 0 ? 1e6 : 0.0;
        mesh = test::moved(mesh, {far, -far, far});
        if (mesh.faces.empty()) continue;
        std::vector<tf::face> none;
        mesh.faces.swap(none);  // all points count, as in `check`
        tf::lay_flat_options options;
        const tf::point3 toward{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        if (round % 3 == 1) options.normal = toward;
        if (round % 3 == 2) options.point = toward;
        options.keep_spin = source.below(2) != 0;
        if (source.below(3) == 0) options.precision = tf::precision::float32;
        options.bed = source.in(-1, 1);
        const auto laid = tf::lay_flat(mesh, options);
        REQUIRE(laid);
        check_laid(mesh, *laid, options);
    }
}

TEST_CASE("lay flat: the choice is that of looking at all sides") {
    test::random source(3);
    for (int round = 0; round < 40; ++round) {
        const tf::mesh mesh = turned(random_shape(source, 4), random_rotation(source));
        const tf::point3 toward{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        const auto largest = *tf::lay_flat(mesh);
        CHECK(std::is_sorted(largest.sides.begin(), largest.sides.end(),
                             [](const auto& a, const auto& b) { return a.area > b.area; }));
        CHECK(largest.sides[largest.chosen].area >= largest.sides[0].area * (1 - 0x1p-39));
        const auto facing = *tf::lay_flat(mesh, {.normal = toward});
        const auto along = [&](const tf::hull_side& s) {
            return s.normal.x * toward.x + s.normal.y * toward.y + s.normal.z * toward.z;
        };
        for (const tf::hull_side& s : facing.sides)
            CHECK(along(s) <= along(facing.sides[facing.chosen]) + 1e-12);
        // each side by a point of it, also one a little off
        for (std::size_t i = 0; i < facing.sides.size(); ++i) {
            if (facing.sides[i].area < 0.01) continue;
            const tf::point3 &c = facing.sides[i].center, &n = facing.sides[i].normal;
            const tf::point3 off{c.x + 1e-4 * n.x, c.y + 1e-4 * n.y, c.z + 1e-4 * n.z};
            const auto held = *tf::lay_flat(mesh, {.point = off});
            CHECK(held.chosen == i);
        }
    }
}

TEST_CASE(
    "lay flat: straight up and straight down, and nearly so, are turned by as much as it takes") {
    for (const double z : {1.0, -1.0})
        for (const double x : {0.0, 0x1p-60, 1e-9, -1e-9, 1e-3}) {
            // a flat square, tilted by x about the y axis
            tf::mesh sheet;
            sheet.points = {{0, 0, 0}, {1, 0, x}, {1, 1, x}, {0, 1, 0}};
            sheet.faces = {{0, 1, 2}, {0, 2, 3}};
            const tf::lay_flat_options options{.normal = tf::point3{0, 0, z}, .keep_spin = true};
            const auto laid = tf::lay_flat(sheet, options);
            REQUIRE(laid);
            REQUIRE(laid->on_bed.size() == 4);
            check_laid(sheet, *laid, options);
            CHECK(laid->matrix.rows[2][2] == doctest::Approx(-z).epsilon(1e-5));
        }
}

TEST_CASE("lay flat: points that no face uses move along and do not count") {
    tf::mesh mesh = test::box(3, 2, 1);
    test::random source(9);
    mesh = turned(mesh, random_rotation(source));
    const auto without = *tf::lay_flat(mesh);
    mesh.points.push_back({0, 0, -100});
    const auto with = *tf::lay_flat(mesh);
    CHECK(with.matrix == without.matrix);
    CHECK(with.on_bed == without.on_bed);
    CHECK(with.points.size() == 9);
    CHECK(distance_between(with.points[8], with.matrix(mesh.points[8])) < 1e-12);
}

TEST_CASE("lay flat: a cloud lies on its lowest point, prepared or not") {
    const std::vector<tf::point3> corners = test::box(3, 2, 1).points;
    const auto laid = tf::lay_flat(corners);
    REQUIRE(laid->contact.has_value());
    CHECK(laid->contact->point.z == 0.0);
    const auto prepared = tf::lay_flat(tf::prepared_mesh::borrow({corners}));
    CHECK(prepared->points == laid->points);
    CHECK(prepared->contact->moving == laid->contact->moving);
}

TEST_CASE("lay flat: there is no side to a line, a point or nothing") {
    CHECK_FALSE(tf::lay_flat(tf::mesh_view{}));
    const std::vector<tf::point3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    CHECK_FALSE(tf::lay_flat({line, {}}));
    const std::vector<tf::face> face{{0, 1, 2}};
    CHECK_FALSE(tf::lay_flat({line, face}));
}

TEST_CASE("lay flat: sides whose areas no double holds are joined and laid down like others") {
    for (const double size : {0x1p1000, 0x1p-1000}) {
        tf::mesh box = test::box(3, 2, 1);
        for (tf::point3& p : box.points) p = {p.x * size, p.y * size, p.z * size};
        box.points[6].z *= 1.0 + 0x1p-50;  // two faces to one side
        const auto laid = tf::lay_flat(box, {.tolerance = 0x1p-40 * size});
        REQUIRE(laid);
        CHECK(laid->on_bed.size() == 4);
        for (const tf::hull_side& side : laid->sides)
            CHECK(std::abs(std::hypot(side.normal.x, side.normal.y, side.normal.z) - 1.0) < 1e-12);
    }
}

TEST_CASE("lay flat: edges whose lengths no double holds are not turned along") {
    constexpr double most = std::numeric_limits<double>::max();
    const std::vector<tf::point3> points{
        {most, most, most}, {-most, -most, most}, {-most, most, -most}, {most, -most, -most}};
    const std::vector<tf::face> faces{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::lay_flat({points, faces})),
                         doctest::Contains("too large"), std::overflow_error);
}

TEST_CASE("lay flat: the same on any number of threads") {
    const tf::mesh ball = test::ball(4, 1.0);
    const auto one = *tf::lay_flat(ball);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::lay_flat(ball)->points == one.points);
    }
}

TEST_CASE("lay flat: what cannot be meant is refused") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const tf::mesh& mesh, const tf::lay_flat_options& options) {
        CHECK_THROWS_AS(static_cast<void>(tf::lay_flat(mesh, options)), std::invalid_argument);
    };
    tf::mesh box = test::box(1, 1, 1);
    refused(box, {.normal = tf::point3{}});
    refused(box, {.normal = tf::point3{nan, 0, 1}});
    refused(box, {.point = tf::point3{0, nan, 1}});
    refused(box, {.normal = tf::point3{0, 0, 1}, .point = tf::point3{}});
    refused(box, {.point = tf::point3{}, .most_stable = true});
    refused(box, {.bed = nan});
    refused(box, {.tolerance = -1.0});
    box.faces[3][1] = 8;
    refused(box, {});
    box = test::box(1, 1, 1);
    box.points[5].z = nan;
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::lay_flat(box)), doctest::Contains("point 5"),
                         std::invalid_argument);
}

TEST_CASE("lay flat: a box tips over the nearest edge of the side that it stands on") {
    const tf::mesh box = test::moved(test::box(6, 4, 2), {100, -20, 3});
    const auto laid = tf::lay_flat(box, {.most_stable = true});
    REQUIRE(laid);
    CHECK(laid->mass_dimension == 3);
    CHECK(distance_between(laid->center_of_mass, {103, -18, 4}) < 1e-12);
    REQUIRE(laid->tip_angles.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        const double height = 48.0 / laid->sides[i].area;  // the box has a volume of 48
        const double half = height == 2 ? 2.0 : 1.0;       // of the shorter edge of that side
        CHECK(laid->center_heights[i] == doctest::Approx(0.5 * height).epsilon(1e-13));
        CHECK(laid->tip_angles[i] ==
              doctest::Approx(std::atan2(half, 0.5 * height) * 180 / 3.14159265358979)
                  .epsilon(1e-13));
        CHECK(laid->overhangs[i] == 0.0);
    }
    CHECK(laid->sides[laid->chosen].area == 24);
}

TEST_CASE("lay flat: the most stable side need not be the largest, and some do not hold it") {
    // A flag on a pole with a foot: the largest side of the hull lies under the flag.
    tf::mesh flag =
        test::together(test::box(8, 8, 2), test::moved(test::box(1, 1, 30), {0, 3.5, 2}));
    flag = test::together(flag, test::moved(test::box(20, 1, 6), {1, 3.5, 26}));
    const auto largest = tf::lay_flat(flag);
    const auto stable = tf::lay_flat(flag, {.most_stable = true});
    REQUIRE(largest);
    REQUIRE(stable);
    CHECK(largest->sides == stable->sides);
    double most = -90.0;
    bool falls = false;
    for (const double angle : stable->tip_angles) {
        most = std::max(most, angle);
        falls = falls || angle < 0.0;
    }
    CHECK(stable->tip_angles[stable->chosen] == most);
    CHECK(falls);
    // A heavy foot on a sheet that reaches out: the sheet is larger, and the foot's end firmer.
    const tf::mesh sign =
        test::together(test::box(10, 10, 4), test::moved(test::box(60, 0.1, 1), {10, 0, 1.5}));
    const auto by_area = tf::lay_flat(sign);
    const auto by_angle = tf::lay_flat(sign, {.most_stable = true});
    CHECK(by_area->tip_angles[by_area->chosen] < by_angle->tip_angles[by_angle->chosen]);
    check_laid(flag, *stable, {.most_stable = true});
    // By its definition: the least tilt over an edge of the side, seen from above after the turn.
    for (const auto* laid : {&*largest, &*stable}) {
        const tf::point3 c = laid->matrix(laid->center_of_mass);
        std::vector<tf::point3> down;
        for (const std::uint32_t i : laid->on_bed)
            down.push_back({laid->points[i].x, laid->points[i].y, 0});
        double least = 1e9;
        for (const tf::point3& a : down)
            for (const tf::point3& b : down) {
                const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
                if (length < 1e-9) continue;
                const auto left = [&](const tf::point3& p) {
                    return (x * (p.y - a.y) - y * (p.x - a.x)) / length;
                };
                if (std::all_of(down.begin(), down.end(), [&](auto& p) { return left(p) > -1e-9; }))
                    least = std::min(least, left(c));
            }
        CHECK(laid->tip_angles[laid->chosen] ==
              doctest::Approx(std::atan2(least, c.z) * 180 / 3.14159265358979).epsilon(1e-9));
    }
}

TEST_CASE("lay flat: the center of mass is of the solid, of the surface, or of the points") {
    tf::mesh box = test::box(2, 2, 2);
    box.faces.erase(box.faces.begin() + 2, box.faces.begin() + 4);  // without its top
    const auto open = tf::lay_flat(box);
    REQUIRE(open);
    CHECK(open->mass_dimension == 2);
    CHECK(distance_between(open->center_of_mass, {1, 1, 0.8}) < 1e-14);
    tf::mesh inside_out = test::box(2, 2, 2);
    for (auto& [a, b, c] : inside_out.faces) std::swap(a, b);
    CHECK(tf::lay_flat(inside_out)->mass_dimension == 3);
    CHECK(distance_between(tf::lay_flat(inside_out)->center_of_mass, {1, 1, 1}) < 1e-14);
    const auto cloud = tf::lay_flat(tf::mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {}});
    REQUIRE(cloud);
    CHECK(cloud->mass_dimension == 0);
    CHECK(distance_between(cloud->center_of_mass, {1, 1, 1}) < 1e-14);
}

TEST_CASE("lay flat: overhang is what looks down by more than the angle and is not on the bed") {
    // Two feet and a beam over them; under the beam a roof of 45 degrees.
    const tf::mesh feet =
        test::together(test::box(1, 5, 3), test::moved(test::box(1, 5, 3), {4, 0, 0}));
    const tf::mesh table = test::together(feet, test::moved(test::box(9, 5, 1), {-2, 0, 4}));
    const tf::lay_flat_options down{.normal = tf::point3{0, 0, -1}};
    const auto laid = tf::lay_flat(table, down);
    REQUIRE(laid);
    CHECK(laid->overhangs[laid->chosen] == 45.0);  // the beam's, all of it
    tf::mesh wedge;                                // leans over by 45 degrees
    wedge.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 1}, {1, 0, 1},
                    {0, 3, 0}, {1, 3, 0}, {2, 3, 1}, {1, 3, 1}};
    wedge.faces = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}, {0, 5, 1}, {0, 4, 5},
                   {1, 6, 2}, {1, 5, 6}, {2, 7, 3}, {2, 6, 7}, {3, 4, 0}, {3, 7, 4}};
    tf::lay_flat_options options = down;
    for (const auto& [angle, area] :
         {std::pair(44.9, 3 * std::sqrt(2.0)), {45.0, 0.0}, {50.0, 0.0}}) {
        options.overhang_angle = angle;
        const auto leaning = tf::lay_flat(wedge, options);
        CHECK(leaning->overhangs[leaning->chosen] == doctest::Approx(area));
    }
    options.overhang_angle = 91;
    CHECK_THROWS_AS(static_cast<void>(tf::lay_flat(wedge, options)), std::invalid_argument);
    options = {.overhang_sides = 1};
    const auto few = tf::lay_flat(table, options);
    for (std::size_t i = 0; i < few->sides.size(); ++i)
        CHECK(std::isnan(few->overhangs[i]) == (i >= 1 && i != few->chosen));
}
