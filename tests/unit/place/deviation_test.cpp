#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
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
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using test::ball;
using test::box;
using test::moved;

tf::deviation_result found_for(const tf::mesh& a, const tf::mesh& b,
                               const tf::deviation_options& options = {}) {
    const auto found = tf::deviation(a, b, options);
    REQUIRE(found.has_value());
    return *found;
}

tf::mesh points_only(std::vector<tf::point3> points) { return {std::move(points), {}}; }

/// Point after point: the distance is that of `closest_point`, the side that of `locate`.
void check_each(const tf::mesh& a, const tf::mesh& b, const tf::deviation_result& found) {
    const auto solid = tf::prepared_mesh::borrow(b);
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        const auto nearest = tf::closest_point(solid, a.points[i]);
        const auto where = tf::locate(solid, a.points[i]).where;
        CAPTURE(i);
        if (where == tf::location::boundary) {
            CHECK(found.distances[i] == 0.0);
        } else {
            REQUIRE(std::abs(found.distances[i]) == nearest->distance);
            REQUIRE(std::signbit(found.distances[i]) == (where == tf::location::inside));
        }
        CHECK(found.faces[i] == nearest->face);
    }
}

}  // namespace

TEST_CASE("deviation: of nothing, or from nothing, there is none") {
    CHECK_FALSE(tf::deviation(tf::mesh{}, box(1, 1, 1)).has_value());
    CHECK_FALSE(tf::deviation(box(1, 1, 1), tf::mesh{}).has_value());
}

TEST_CASE("deviation: points outside, inside and on a box") {
    const tf::mesh a =
        points_only({{0.5, 0.5, 1.25}, {0.5, 0.5, 0.75}, {0.5, 0.25, 1}, {-3, 0.5, 0.5}});
    const auto found = found_for(a, box(1, 1, 1), {.band = std::array{-0.25, 0.0}});
    CHECK(found.is_signed);
    CHECK(found.distances == std::vector<double>{0.25, -0.25, 0.0, 3.0});
    CHECK(found.mean == 0.75);
    CHECK(found.mean_absolute == 0.875);
    CHECK(found.rms == doctest::Approx(std::sqrt((0.0625 + 0.0625 + 9.0) / 4.0)));
    CHECK(found.p50 == 0.25);
    CHECK(found.p95 == 3.0);
    CHECK(found.max == 3.0);
    CHECK(found.worst == 3);
    CHECK(found.lowest == -0.25);
    CHECK(found.highest == 3.0);
    CHECK(found.max_bound >= 3.0);
    CHECK(found.max_bound < 3.0 + 1e-12);
    CHECK(found.reverse_max.value() == doctest::Approx(std::sqrt(1.0625)));  // of (0, 0, 0)
    CHECK(found.band_counts == std::array<std::uint64_t, 3>{0, 2, 2});
}

TEST_CASE("deviation: the band is closed at both ends, and has to be a band") {
    const tf::mesh a = points_only({{0.5, 0.5, 1.25}});
    const auto within = [&](double low, double high) {
        return found_for(a, box(1, 1, 1), {.band = std::array{low, high}}).band_counts->at(1);
    };
    CHECK(within(0.25, 0.25) == 1);
    CHECK(within(0.0, std::nextafter(0.25, 0.0)) == 0);
    CHECK(within(std::nextafter(0.25, 1.0), 1.0) == 0);
    CHECK_THROWS_AS(within(1.0, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(within(std::nan(""), 0.0), std::invalid_argument);
}

TEST_CASE("deviation: an open surface and a cloud have no inside, so distances have no sign") {
    tf::mesh open = box(1, 1, 1);
    open.faces.pop_back();
    const tf::mesh a = points_only({{0.5, 0.5, 0.75}});
    CHECK_FALSE(found_for(a, open).is_signed);
    CHECK(found_for(a, open).distances[0] == 0.25);
    const std::vector<tf::point3> cloud{{0.5, 0.5, 0.5}, {9, 9, 9}};
    const auto found = tf::deviation(tf::prepared_mesh(points_only(a.points)), cloud);
    CHECK_FALSE(found->is_signed);
    CHECK(found->distances[0] == 0.25);
}

TEST_CASE("deviation: a file that repeats its corners is closed all the same") {
    const auto found = found_for(points_only({{0.5, 0.5, 0.75}}), test::unjoined(box(1, 1, 1)));
    CHECK(found.is_signed);
    CHECK(found.distances[0] == -0.25);
}

TEST_CASE("deviation: points of `b` that no face uses change nothing on the way back") {
    const tf::mesh a = ball(2, 1.0), b = box(1, 1, 1);
    tf::mesh more = b;
    more.points.insert(more.points.begin(), 5, tf::point3{90, 0, 0});
    for (tf::face& f : more.faces)
        for (std::uint32_t& corner : f) corner += 5;
    const auto expected = found_for(a, b), found = found_for(a, more);
    REQUIRE((expected.reverse_max && expected.reverse_max_bound));
    CHECK(found.reverse_max == expected.reverse_max);
    CHECK(found.reverse_max_bound == expected.reverse_max_bound);
}

TEST_CASE("deviation: each distance and side is that of the point alone") {
    test::random source(1);
    const tf::mesh b = ball(4, 1.0);
    for (const double spread : {1e-6, 1e-3, 0.1, 1.0}) {
        tf::mesh a;
        for (int i = 0; i < 3000; ++i) {
            tf::point3 p{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
            const double length = std::hypot(p.x, p.y, p.z);
            for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] / length + spread * source.in(-1, 1);
            a.points.push_back(p);
        }
        a.points.insert(a.points.end(), b.points.begin(), b.points.end());
        const auto found = found_for(a, b);
        check_each(a, b, found);
        const tf::prepared_mesh solid = tf::prepared_mesh::borrow(b);
        const auto counts = tf::count_sides(a.points, std::span(&solid, 1));
        CHECK(found.side_counts == counts);
        CHECK(found.winding_numbers < a.points.size());
    }
}

TEST_CASE(
    "deviation: sides of a solid that passes through itself, folds and touches, on a lattice") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        tf::mesh b;
        for (int i = 0; i < 6; ++i) b = test::together(std::move(b), test::lattice_box(source));
        if (seed % 2 == 1) b = test::inside_out(b);
        tf::mesh a;
        for (int i = 0; i < 2000; ++i)
            a.points.push_back({0.5 * static_cast<double>(source.below(16)) - 0.5,
                                0.5 * static_cast<double>(source.below(16)) - 0.5,
                                0.25 * static_cast<double>(source.below(32)) - 0.5});
        check_each(a, b, found_for(a, b));
    }
}

TEST_CASE(
    "deviation: from one of two equal meshes all is 0, from a moved one what it was moved by") {
    const tf::mesh b = ball(3, 1.0);
    const auto none = found_for(b, b);
    CHECK(none.max == 0.0);
    CHECK(none.rms == 0.0);
    CHECK(none.reverse_max == 0.0);
    CHECK(none.histogram.at(0) == b.points.size());
    const auto far = found_for(moved(b, {100, 0, 0}), b);
    CHECK(far.max <= 100.0);
    CHECK(far.max_bound > far.max);
    CHECK(*far.reverse_max <= 100.0);
    CHECK(far.lowest > 97.9);
}

TEST_CASE("deviation: no point of a face is further away than the bound says") {
    test::random source(5);
    for (int round = 0; round < 20; ++round) {
        const tf::mesh a = test::random_tetrahedron(source, 4.0), b = ball(2, 1.0);
        const auto found = found_for(a, b);
        const auto solid = tf::prepared_mesh::borrow(b);
        for (const tf::face& f : a.faces)
            for (int i = 0; i < 200; ++i) {
                double u = source.unit(), v = source.unit();
                if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
                tf::point3 p{};
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = a.points[f[0]][k] + u * (a.points[f[1]][k] - a.points[f[0]][k]) +
                           v * (a.points[f[2]][k] - a.points[f[0]][k]);
                REQUIRE(tf::closest_point(solid, p)->distance <= found.max_bound + 1e-12);
            }
    }
}

TEST_CASE("deviation: the histogram counts each point once, the greatest in the last interval") {
    const tf::mesh a = points_only({{0.5, 0.5, 1.0}, {0.5, 0.5, 2.0}, {0.5, 0.5, 5.0}});
    const auto found = found_for(a, box(1, 1, 1), {.bins = 4});
    CHECK(found.lowest == 0.0);
    CHECK(found.highest == 4.0);
    CHECK(found.histogram == std::vector<std::uint64_t>{1, 1, 0, 1});
    CHECK(found_for(a, box(1, 1, 1), {.bins = 0}).histogram.empty());
    CHECK_THROWS_AS(found_for(a, box(1, 1, 1), {.bins = std::size_t{1} << 21}),
                    std::invalid_argument);
}

TEST_CASE("deviation: several fixed meshes are one surface") {
    std::vector<tf::prepared_mesh> fixed;
    fixed.emplace_back(box(1, 1, 1));
    fixed.emplace_back(moved(box(1, 1, 1), {10, 0, 0}));
    const tf::prepared_mesh a(points_only({{0.5, 0.5, 0.75}, {10.5, 0.5, 0.75}, {5, 0.5, 0.5}}));
    const auto found = tf::deviation(a, fixed);
    CHECK(found->distances == std::vector<double>{-0.25, -0.25, 4.0});
    CHECK(found->faces[1] >= 12);
}

TEST_CASE("deviation: the same on one thread, and of a borrowed mesh") {
    const tf::mesh a = moved(ball(5, 1.0), {0.01, 0.02, 0}), b = ball(5, 1.0);
    const auto all = found_for(a, b);
    const tf::thread_scope one(1);
    const auto single = found_for(a, b);
    CHECK(all.distances == single.distances);
    CHECK(all.rms == single.rms);
    CHECK(all.winding_numbers == single.winding_numbers);
}

TEST_CASE("deviation: points that are not finite are named, and it stops when told to") {
    const double nan = std::nan("");
    CHECK_THROWS_WITH_AS(found_for(points_only({{0, 0, 0}, {0, nan, 0}}), box(1, 1, 1)),
                         "treeform::deviation: point 1 is not finite", std::invalid_argument);
    const auto stopped =
        found_for(ball(3, 1), box(1, 1, 1), {.progress = [](double) { return false; }});
    CHECK(stopped.status == tf::status::cancelled);
    CHECK(stopped.distances.empty());
}

TEST_CASE("deviation: distances come back to the points of the file, with colors") {
    tf::mesh_file file;
    file.mesh = test::unjoined(box(1, 1, 1));
    file.mesh.points.push_back({7, 7, 7});  // no face uses it
    tf::body_set set;
    set.add(file);
    std::vector<double> distances;
    for (const tf::point3& p : set.shapes[0].indexed_view().points) distances.push_back(p.x - 0.5);
    const auto back = set.distances_in_file(0, distances);
    REQUIRE(back.size() == file.mesh.points.size());
    for (std::size_t i = 0; i + 1 < back.size(); ++i) CHECK(back[i] == file.mesh.points[i].x - 0.5);
    CHECK(std::isnan(back.back()));
    tf::deviation_result::color(file, back, -0.5, 0.5);
    const tf::element* const rows = file.attributes.find("vertex");
    REQUIRE(rows != nullptr);
    const tf::column *const red = rows->find("red"), *const blue = rows->find("blue");
    for (std::size_t i = 0; i + 1 < back.size(); ++i)
        CHECK((red->number(i) > blue->number(i)) == (back[i] > 0.0));
    CHECK(red->number(back.size() - 1) == 128.0);
    CHECK_THROWS_AS(tf::deviation_result::color(file, distances, -1, 1), std::invalid_argument);
    CHECK_THROWS_AS(tf::deviation_result::color(file, back, 0.5, 1), std::invalid_argument);
}

TEST_CASE("deviation: a result colors its own distances, up to p99 both ways") {
    const auto colors_of = [](const tf::deviation_result& found, double scale) {
        tf::mesh_file own, given;
        own.mesh = given.mesh = ball(3, 1);
        found.color(own);
        tf::deviation_result::color(given, found.distances, -scale, scale);
        return std::pair{own.attributes, given.attributes};
    };
    tf::deviation_result found = found_for(ball(3, 1), box(1, 1, 1));
    found.p99 = 0.5 * found.max;  // of a ball, nearly the same
    const auto [own, given] = colors_of(found, found.p99);
    CHECK(own == given);
    found.p99 = 0.0;
    const auto [flat, full] = colors_of(found, found.max);
    CHECK(flat == full);
    CHECK(flat != own);
    tf::mesh_file other;
    CHECK_THROWS_AS(found.color(other), std::invalid_argument);
}
