/// \file
/// Isolines: beside sections, on open sheets, through vertices; meshes cut along them.

#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

template <class Value>
std::vector<double> values_of(const tf::mesh& mesh, const Value& value) {
    std::vector<double> values;
    for (const tf::point3& p : mesh.points) values.push_back(value(p));
    return values;
}

double height(const tf::point3& p) { return p.z; }

double area_of(const tf::cut_result& made) {
    double area = 0.0;
    for (const tf::cut_piece& piece : made.pieces) area += tf::surface_area(piece.mesh);
    return area;
}

/// All pieces as one mesh, equal points joined.
tf::topology_counts counts_of(const tf::cut_result& made) {
    std::vector<tf::mesh_view> all;
    for (const tf::cut_piece& piece : made.pieces) all.push_back(piece.mesh);
    const tf::mesh whole = tf::join_equal_points(tf::concatenate(all));
    return tf::count_topology(whole.points.size(), whole.faces);
}

}  // namespace

TEST_CASE("isolines of the height are sections") {
    const tf::mesh ball = test::ball(4, 2.0);
    const std::array levels{-1.5, -0.25, 0.0, 0.5, 1.9, 3.0};
    const auto lines = tf::isolines(ball, values_of(ball, height), levels);
    const auto layers = tf::section(ball, {}, levels);
    REQUIRE(lines.lines.size() == layers.loops.size());
    for (std::size_t l = 0; l < layers.loops.size(); ++l) {
        const tf::isoline& line = lines.lines[l];
        CHECK(line.closed);
        CHECK(line.oriented);
        CHECK(line.point_count == layers.loops[l].point_count);
        CHECK(line.length == doctest::Approx(layers.loops[l].length).epsilon(1e-12));
        for (std::size_t i = 0; i < line.point_count; ++i) {
            const tf::point3& p = lines.points[line.first_point + i];
            const tf::point2& q = layers.points[layers.loops[l].first_point + i];
            CHECK(std::abs(p.z - line.level) < 1e-15);
            CHECK(std::hypot(p.x - q.x, p.y - q.y) < 1e-14);
        }
    }
}

TEST_CASE("isolines end where the mesh does, and go through vertices") {
    const tf::mesh sheet = test::grid(8);
    const auto along = values_of(sheet, [](const tf::point3& p) { return p.x; });
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    const double middle = sheet.points[1].x != sheet.points[0].x ? sheet.points[1].x : 1.0;
    const auto lines = tf::isolines(sheet, along, std::array{middle, *low, *high + 1.0});
    REQUIRE(lines.lines.size() == 1);  // at the lowest value, nothing is below
    CHECK_FALSE(lines.lines[0].closed);
    CHECK(lines.lines[0].point_count == 9);
    for (const tf::point3& p : lines.points) CHECK(p.x == middle);
}

TEST_CASE("a mesh cut along isolines is the mesh, in pieces of its values") {
    test::random random(7);
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        const tf::mesh ball = test::ball(3, 1.0);
        const std::array<double, 3> n{random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
        const bool whole = round % 2 == 0;  // values that meet levels exactly
        const auto values = values_of(ball, [&](const tf::point3& p) {
            const double v = std::sin(3 * p.x * n[0]) + p.y * n[1] + p.z * p.z * n[2];
            return whole ? std::round(v * 4) : v;
        });
        std::vector<double> levels{0.0, -1.0, 0.25, 1.0, 0.25};
        const auto made = tf::cut_along(ball, values, levels);
        REQUIRE(made.pieces.size() == 5);  // four different levels
        CHECK(made.certificate);
        CHECK(area_of(made) == doctest::Approx(tf::surface_area(ball)).epsilon(1e-12));
        CHECK(counts_of(made).closed_manifold);
        std::sort(levels.begin(), levels.end());
        levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
        for (std::size_t k = 0; k < made.pieces.size(); ++k) {
            const tf::cut_piece& piece = made.pieces[k];
            REQUIRE(piece.face_source.size() == piece.mesh.faces.size());
            REQUIRE(piece.vertex_source.size() == piece.mesh.points.size());
            for (std::size_t v = 0; v < piece.mesh.points.size(); ++v) {
                const std::uint32_t source = piece.vertex_source[v];
                if (source == tf::cut_piece::none) continue;
                CHECK(piece.mesh.points[v] == ball.points[source]);
                if (k > 0) CHECK(values[source] >= levels[k - 1]);
                if (k + 1 < made.pieces.size()) CHECK(values[source] <= levels[k]);
            }
        }
    }
}

TEST_CASE("levels beyond all values leave the mesh in one piece, as it is") {
    const tf::mesh box = test::box(1, 2, 3);
    const auto made = tf::cut_along(box, values_of(box, height), std::array{7.0});
    CHECK(made.pieces[0].mesh.faces.size() == box.faces.size());
    CHECK(made.pieces[1].mesh.faces.empty());
    CHECK(tf::isolines(box, values_of(box, height), std::array{7.0}).lines.empty());
    CHECK(tf::isolines(tf::mesh{}, {}, std::array{0.0}).lines.empty());
}

TEST_CASE("isolines: huge values and levels, soups, threads") {
    const tf::mesh ball = test::ball(3, 1.0);
    const double huge = 0.75 * std::numeric_limits<double>::max();
    const auto wide = values_of(ball, [&](const tf::point3& p) { return huge * p.z; });
    const auto lines = tf::isolines(ball, wide, std::array{0.5 * huge});
    REQUIRE(lines.lines.size() == 1);
    for (const tf::point3& p : lines.points) CHECK(p.z == doctest::Approx(0.5).epsilon(1e-12));
    tf::mesh soup;
    for (const tf::face& f : ball.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t v : f) soup.points.push_back(ball.points[v]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    const auto of_soup = tf::isolines(soup, values_of(soup, height), std::array{0.3, 0.6});
    CHECK(of_soup.lines.size() == 2);
    CHECK(of_soup.lines[0].closed);
    const auto again = [&] {
        const tf::thread_scope one(1);
        return tf::isolines(soup, values_of(soup, height), std::array{0.3, 0.6});
    }();
    CHECK(again.points == of_soup.points);
    CHECK(again.faces == of_soup.faces);
}

TEST_CASE("isolines: what has no value is refused; progress may stop it") {
    const tf::mesh box = test::box(1, 2, 3);
    std::vector<double> values = values_of(box, height);
    const std::array levels{1.0};
    CHECK_THROWS_AS((void)tf::isolines(box, std::span(values).first(3), levels),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::isolines(box, values, std::array{std::nan("")}),
                    std::invalid_argument);
    const auto stop = [](double) { return false; };
    CHECK(tf::isolines(box, values, levels, stop).status == tf::status::cancelled);
    CHECK(tf::cut_along(box, values, levels, {.progress = stop}).certificate.status ==
          tf::status::cancelled);
    values[3] = std::nan("");
    CHECK_THROWS_WITH_AS((void)tf::cut_along(box, values, levels),
                         "treeform::cut_along: the value of vertex 3 is not finite",
                         std::invalid_argument);
}
