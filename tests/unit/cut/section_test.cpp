/// \file
/// Sections: loops, how they lie in each other, planes through vertices, edges and faces, meshes
/// that are no solids.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>
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
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

tf::mesh inside_out(tf::mesh mesh) {
    for (tf::face& f : mesh.faces) std::swap(f[1], f[2]);
    return mesh;
}

/// The section at one height of what lies along z.
tf::section_result at(const tf::mesh& mesh, double height) {
    return tf::section(mesh, {}, std::array{height});
}

std::span<const tf::point2> points_of(const tf::section_result& made, std::size_t loop) {
    return std::span(made.points)
        .subspan(made.loops[loop].first_point, made.loops[loop].point_count);
}

/// Area and length by segments alone, nothing linked. \pre no vertex lies in the plane
std::array<double, 2> by_segments(const tf::mesh& mesh, const tf::oriented_plane& plane,
                                  const std::array<tf::point3, 3>& axes) {
    const auto dot = [](const tf::point3& a, const tf::point3& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    const auto height = [&](std::uint32_t v) {
        return dot(axes[2], mesh.points[v]) - dot(axes[2], plane.at);
    };
    double area = 0.0, length = 0.0;
    for (const tf::face& f : mesh.faces) {
        tf::point2 from, to;
        bool any = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = f[i], b = f[(i + 1) % 3];
            const double up = height(a), down = height(b);
            if ((up > 0) == (down > 0)) continue;
            any = true;
            const tf::point3 &p = mesh.points[a], &q = mesh.points[b];
            const double t = up / (up - down);
            const tf::point3 x{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)};
            (up > 0 ? from : to) = {dot(axes[0], x), dot(axes[1], x)};
        }
        if (!any) continue;
        area += (from.x * to.y - from.y * to.x) / 2;
        length += std::hypot(to.x - from.x, to.y - from.y);
    }
    return {area, length};
}

bool is_inside(std::span<const tf::point2> loop, const tf::point2& q) {
    bool in = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const tf::point2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        if ((a.x <= q.x) == (b.x <= q.x)) continue;
        if (a.y + (b.y - a.y) * (q.x - a.x) / (b.x - a.x) < q.y) in = !in;
    }
    return in;
}

/// What holds of every section of a solid.
void check_layers(const tf::section_result& made) {
    for (const tf::section_layer& layer : made.layers) {
        CHECK(layer.open_count == 0);
        double area = 0.0, length = 0.0;
        for (std::uint32_t l = layer.first_loop; l < layer.first_loop + layer.loop_count; ++l) {
            const tf::section_loop& loop = made.loops[l];
            CHECK(loop.closed);
            CHECK(loop.oriented);
            CHECK(loop.point_count >= 3);
            CHECK((loop.area > 0.0) == (loop.depth % 2 == 0));
            CHECK((loop.parent == tf::section_loop::none) == (loop.depth == 0));
            if (loop.depth > 0) CHECK(made.loops[loop.parent].depth + 1 == loop.depth);
            area += loop.area;
            length += loop.length;
        }
        CHECK(layer.area == area);
        CHECK(layer.length == length);
    }
}

}  // namespace

TEST_CASE("a box has a square in it") {
    const tf::section_result made = at(test::box(2, 3, 1), 0.5);
    check_layers(made);
    REQUIRE(made.loops.size() == 1);
    CHECK(made.layers[0].area == 6.0);
    CHECK(made.layers[0].length == 10.0);
    CHECK(made.layers[0].at == tf::point3{0, 0, 0.5});
    CHECK(made.points.size() == 4);  // corners; diagonals of sides leave no point
    for (const tf::point2& p : made.points)
        CHECK((p.x == 0.0 || p.x == 2.0 || p.y == 0.0 || p.y == 3.0));
    CHECK(made.in_space(made.layers[0], {2, 3}) == tf::point3{2, 3, 0.5});
}

TEST_CASE("a section is that of a plane just below") {
    const tf::mesh box = test::box(1, 1, 1);
    CHECK(at(box, 0.0).loops.empty());
    CHECK(at(box, 1.0).layers[0].area == 1.0);
    CHECK(at(box, std::nextafter(1.0, 2.0)).loops.empty());
    // Upside down it is the other way around.
    const tf::oriented_plane down{{}, {0, 0, -2}};
    CHECK(tf::section(box, down).layers[0].area == 1.0);
    CHECK(tf::section(box, {{0, 0, 1}, {0, 0, -1}}).loops.empty());
    const tf::mesh tower = tf::unite(box, test::moved(test::box(2, 2, 1), {0, 0, 1})).value();
    CHECK(at(tower, 1.0).layers[0].area == 1.0);
    CHECK(at(tower, 2.0).layers[0].area == 4.0);
}

TEST_CASE("a tip or ridge in the plane is no section") {
    const tf::mesh pyramid{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}},
                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    CHECK(at(pyramid, 1.0).loops.empty());
    CHECK(at(test::moved(pyramid, {0, 0, -1}), -1.0).loops.empty());
    const tf::mesh roof{
        {{0, 0, 0}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0}, {1, 0, 1}, {1, 4, 1}},
        {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 5}, {1, 5, 4}, {2, 3, 5}, {3, 0, 4}, {3, 4, 5}}};
    CHECK(tf::signed_volume(roof) == doctest::Approx(4.0));
    CHECK(at(roof, 1.0).loops.empty());
    CHECK(at(roof, 0.5).layers[0].area == doctest::Approx(4.0));
}

TEST_CASE("loops lie in each other as cavities and what is in them do") {
    tf::mesh nest = test::box(7, 7, 7);
    for (int i = 1; i < 4; ++i) {
        const double size = 7.0 - 2 * i;
        const tf::mesh box = test::moved(test::box(size, size, size), {1.0 * i, 1.0 * i, 1.0 * i});
        nest = test::together(nest, i % 2 == 1 ? inside_out(box) : box);
    }
    nest = test::together(nest, test::moved(test::box(1, 1, 7), {9, 9, 0}));
    for (const tf::oriented_plane& plane :
         {tf::oriented_plane{{0, 0, 3.5}}, tf::oriented_plane{{3, 3, 3.5}, {0.01, 0.02, 1}}}) {
        const tf::section_result made = tf::section(nest, plane);
        check_layers(made);
        REQUIRE(made.loops.size() == 5);
        for (std::uint32_t l = 0; l < 4; ++l) {
            CHECK(made.loops[l].depth == l);
            CHECK(made.loops[l].parent == (l == 0 ? tf::section_loop::none : l - 1));
        }
        CHECK(made.loops[4].depth == 0);
    }
}

TEST_CASE("loops that touch at corners or in sides keep their nesting") {
    // The corners of the inner one are in the middles of the outer one's sides.
    const auto diamond = [](double r) {
        tf::mesh mesh = test::box(1, 1, 2);
        const std::array<tf::point2, 4> corners{{{1, 1 - r}, {1 + r, 1}, {1 - r, 1}, {1, 1 + r}}};
        for (std::size_t i = 0; i < 8; ++i) {
            mesh.points[i].x = corners[i % 4].x;
            mesh.points[i].y = corners[i % 4].y;
        }
        return mesh;
    };
    const tf::section_result made =
        at(test::together(test::box(2, 2, 2), inside_out(diamond(1))), 1.0);
    check_layers(made);
    REQUIRE(made.loops.size() == 2);
    CHECK(made.loops[1].parent == 0);
    CHECK(made.layers[0].area == 2.0);
    // Two boxes that share an upright edge: two loops, in whatever order their faces are.
    const tf::mesh pair =
        test::together(test::box(1, 1, 1), test::moved(test::box(1, 1, 1), {1, 1, 0}));
    test::random source(5);
    for (int i = 0; i < 20; ++i) {
        tf::mesh shuffled = pair;
        source.shuffle(shuffled.faces);
        const tf::section_result touching = at(shuffled, 0.5);
        check_layers(touching);
        CHECK(touching.loops.size() == 2);
    }
}

TEST_CASE("where a mesh ends, polylines are open, and where neighbors disagree they go on") {
    tf::mesh open = test::box(1, 1, 1);
    open.faces.erase(open.faces.begin() + 6, open.faces.begin() + 8);
    const tf::section_result polyline = at(open, 0.5);
    REQUIRE(polyline.loops.size() == 1);
    CHECK_FALSE(polyline.loops[0].closed);
    CHECK(polyline.loops[0].oriented);
    CHECK(polyline.layers[0].open_count == 1);
    CHECK(polyline.layers[0].length == 3.0);
    CHECK(polyline.layers[0].area == 0.0);

    for (std::uint32_t mask = 1; mask < 256; ++mask) {
        tf::mesh turned = test::box(1, 1, 1);
        for (std::size_t i = 0; i < 8; ++i)
            if ((mask >> i & 1) != 0) std::swap(turned.faces[4 + i][1], turned.faces[4 + i][2]);
        const tf::section_result made = at(turned, 0.5);
        REQUIRE(made.loops.size() == 1);
        REQUIRE(made.loops[0].closed);
        REQUIRE(made.loops[0].oriented == (mask == 255));
        REQUIRE(made.loops[0].point_count == (mask == 255 ? 4 : 8));
        REQUIRE(std::abs(made.loops[0].area) == 1.0);
    }
}

TEST_CASE("a line goes straight through faces in one plane, and bends by as little as they do") {
    for (const double bend : {0.0, 0x1p-40}) {
        tf::mesh strip;  // four squares, each of two triangles
        for (int i = 0; i <= 4; ++i)
            for (const double y : {0.0, 1.0})
                strip.points.push_back({1.0 * i, y, i == 2 ? bend : 0.0});
        for (std::uint32_t i = 0; i < 8; i += 2) {
            strip.faces.push_back({i, i + 2, i + 3});
            strip.faces.push_back({i, i + 3, i + 1});
        }
        const tf::section_result made = tf::section(strip, {{0, 0.25, 0}, {0, 1, 0}});
        REQUIRE(made.loops.size() == 1);
        CHECK(made.points.size() == (bend == 0.0 ? 2 : 5));
        CHECK(made.faces[0] < 2);
        CHECK(made.layers[0].length == 4.0);
    }
    // Two sheets of it, back to back: a loop through nothing keeps its points.
    tf::mesh closed{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    CHECK(tf::section(closed, {{0, 0.25, 0}, {0, 1, 0}}).points.size() < 3);
}

TEST_CASE("a box of many coplanar faces has the sections of one of few") {
    const tf::mesh few = test::box(2, 3, 1);
    tf::mesh many = few;
    for (int times = 0; times < 3; ++times) {  // each face into four, at middles, exactly
        tf::mesh next{many.points, {}};
        for (const auto& [a, b, c] : many.faces) {
            const auto middle = [&](std::uint32_t i, std::uint32_t j) {
                const tf::point3 &p = many.points[i], &q = many.points[j];
                next.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
                return static_cast<std::uint32_t>(next.points.size() - 1);
            };
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            next.faces.insert(next.faces.end(),
                              {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        many = std::move(next);
    }
    test::random source(1);
    for (int i = 0; i < 300; ++i) {
        // Through points of the grid, across axes and diagonals, and anyhow.
        tf::oriented_plane plane{many.points[source.below(many.points.size())], {}};
        for (std::size_t k = 0; k < 3; ++k)
            plane.normal[k] =
                i % 2 == 0 ? static_cast<double>(source.below(3)) - 1.0 : source.in(-1, 1);
        if (plane.normal == tf::point3{}) continue;
        CAPTURE(i);
        const tf::section_result expected = tf::section(few, plane),
                                 made = tf::section(many, plane);
        REQUIRE(made.loops.size() == expected.loops.size());
        CHECK(made.points.size() == expected.points.size());
        CHECK(made.points.size() <= 6);
        CHECK(made.layers[0].area == doctest::Approx(expected.layers[0].area).epsilon(1e-14));
        CHECK(made.layers[0].length == doctest::Approx(expected.layers[0].length).epsilon(1e-14));
    }
}

TEST_CASE("planes through vertices, along edges and in faces, turned") {
    // x + y + z = 1 goes through three corners of the box; just below, the section is their
    // triangle.
    const tf::mesh box = test::box(1, 1, 1);
    const tf::section_result made = tf::section(box, {{1, 0, 0}, {1, 1, 1}});
    check_layers(made);
    REQUIRE(made.loops.size() == 1);
    CHECK(made.points.size() == 3);
    CHECK(made.layers[0].area == doctest::Approx(std::sqrt(3.0) / 2).epsilon(1e-15));
    // x = y holds a diagonal of the top and one of the bottom; the other half is the other side.
    for (const double side : {1.0, -1.0}) {
        const tf::section_result diagonal = tf::section(box, {{}, {side, -side, 0}});
        check_layers(diagonal);
        CHECK(diagonal.layers[0].area == doctest::Approx(std::sqrt(2.0)).epsilon(1e-15));
    }
}

TEST_CASE("sections of lattice solids at whole heights are those a little below") {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        std::vector<tf::mesh> boxes;
        for (int i = 0; i < 6; ++i) boxes.push_back(test::lattice_box(source));
        const tf::mesh solid =
            tf::boolean({boxes[0], boxes[1], boxes[2], boxes[3], boxes[4], boxes[5]},
                        {"(a+b+c+d)-(e^f)", 6})
                .value();
        std::vector<double> whole, below;
        for (int h = 0; h < 8; ++h) {
            whole.push_back(h);
            below.push_back(h - 0x1p-30);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            tf::oriented_plane plane{{}, {0, 0, 0}};
            plane.normal[axis] = 1.0;
            const tf::section_result a = tf::section(solid, plane, whole);
            const tf::section_result b = tf::section(solid, plane, below);
            check_layers(a);
            check_layers(b);
            for (std::size_t i = 0; i < whole.size(); ++i) {
                REQUIRE(a.layers[i].area == doctest::Approx(b.layers[i].area).epsilon(1e-12));
                REQUIRE(a.layers[i].length == doctest::Approx(b.layers[i].length).epsilon(1e-12));
                REQUIRE(a.layers[i].loop_count == b.layers[i].loop_count);
            }
        }
    }
}

TEST_CASE("areas, lengths and nesting are those of segments by themselves") {
    test::random source(11);
    tf::mesh sponge = test::ball(3, 3.0);
    for (int i = 0; i < 12; ++i) {
        tf::mesh hole = test::ball(1 + i % 3, source.in(0.2, 1.5));
        hole = test::moved(hole, {source.in(-3, 3), source.in(-3, 3), source.in(-3, 3)});
        sponge = (i % 3 == 2 ? tf::unite(sponge, hole) : tf::difference(sponge, hole)).value();
    }
    const tf::prepared_mesh prepared = tf::prepared_mesh::borrow(sponge);
    for (int i = 0; i < 60; ++i) {
        const tf::oriented_plane plane{{source.in(-2, 2), source.in(-2, 2), source.in(-2, 2)},
                                       {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)}};
        const tf::section_result made = tf::section(sponge, plane);
        check_layers(made);
        CHECK(tf::section(prepared, plane).points == made.points);
        const auto [area, length] = by_segments(sponge, plane, made.axes);
        CHECK(made.layers[0].area == doctest::Approx(area).epsilon(1e-12));
        CHECK(made.layers[0].length == doctest::Approx(length).epsilon(1e-12));
        for (std::size_t l = 0; l < made.loops.size(); ++l) {
            std::uint32_t depth = 0;
            for (std::size_t m = 0; m < made.loops.size(); ++m)
                depth += l != m && is_inside(points_of(made, m), points_of(made, l)[0]) ? 1 : 0;
            CHECK(made.loops[l].depth == depth);
        }
    }
}

TEST_CASE("of faces in any disorder, every segment is in a polyline") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const tf::mesh soup = test::random_soup(source, 200, 0.5);
        const tf::oriented_plane plane{{0.5, 0.5, 0.5}, {0.3, 0.2, 1.0}};
        const tf::section_result made = tf::section(soup, plane);
        const auto [area, length] = by_segments(soup, plane, made.axes);
        CHECK(made.layers[0].length == doctest::Approx(length).epsilon(1e-12));
        CHECK(made.layers[0].open_count == made.loops.size());
        // On a lattice faces overlap, share edges by the dozen and lie in the planes.
        const tf::mesh dense = test::lattice_soup(source, 300, 40, 4);
        const std::vector<double> heights{0, 0.25, 0.5, 1, 1.5, 2, 3, 4};
        for (const tf::point3& normal : {tf::point3{0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 2, 3}}) {
            const tf::section_result all = tf::section(dense, {{}, normal}, heights);
            CHECK(all.layers.size() == heights.size());
            for (const tf::section_loop& loop : all.loops)
                CHECK(loop.point_count >= (loop.closed ? 3U : 2U));
        }
    }
}

TEST_CASE("many planes at once, in any order, equal ones too, are each by itself") {
    const tf::mesh ball = test::ball(3, 1.0);
    const std::vector<double> heights{0.25, -0.5, 0.25, 2.0, -1.0, 1.0, 0.0, -0.0};
    for (const tf::oriented_plane& plane :
         {tf::oriented_plane{}, tf::oriented_plane{{0.1, 0.2, 0.3}, {1, 2, 3}}}) {
        const tf::section_result made = tf::section(ball, plane, heights);
        REQUIRE(made.layers.size() == heights.size());
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const tf::section_result alone =
                tf::section(ball, plane, std::span(heights).subspan(i, 1));
            const tf::section_layer& layer = made.layers[i];
            CHECK(layer.height == heights[i]);
            CHECK(layer.at == alone.layers[0].at);
            REQUIRE(layer.loop_count == alone.loops.size());
            for (std::uint32_t l = 0; l < layer.loop_count; ++l) {
                const auto here = points_of(made, layer.first_loop + l);
                const auto there = points_of(alone, l);
                CHECK(std::vector(here.begin(), here.end()) ==
                      std::vector(there.begin(), there.end()));
            }
        }
        std::size_t sides = 0;
        for (const tf::section_loop& loop : made.loops) sides += loop.point_count;
        CHECK(sides == made.points.size());
        CHECK(made.faces.size() == made.points.size());
    }
}

TEST_CASE("layers have the volume of a solid, the thinner the nearer") {
    const tf::mesh ball = test::ball(4, 1.0);
    const std::vector<double> heights = tf::oriented_plane{}.layer_heights(ball.points, 0.01);
    CHECK(heights.size() == 200);
    CHECK(heights[0] == doctest::Approx(-0.995));
    double volume = 0.0;
    for (const auto& layer : tf::section(ball, {}, heights).layers) volume += layer.area * 0.01;
    CHECK(volume == doctest::Approx(tf::signed_volume(ball)).epsilon(1e-4));
    CHECK(tf::oriented_plane{}.layer_heights({}, 1.0).empty());
    CHECK_THROWS_AS((void)tf::oriented_plane{}.layer_heights(ball.points, 0.0),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::oriented_plane{}.layer_heights(ball.points, 1e-9),
                    std::invalid_argument);
}

TEST_CASE("corners of equal coordinates are one, and coordinates may have any size") {
    const tf::mesh box = test::box(1, 1, 1);
    tf::mesh soup;
    for (const tf::face& f : box.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t c : f) soup.points.push_back(box.points[c]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    CHECK(at(soup, 0.5).points == at(box, 0.5).points);
    for (const double scale : {0x1p-500, 0x1p-40, 0x1p400}) {
        tf::mesh scaled = test::ball(2, 1.0);
        for (tf::point3& p : scaled.points) p = {p.x * scale, p.y * scale, p.z * scale};
        for (const tf::point3& normal : {tf::point3{0, 0, 1}, tf::point3{1, 2, 3}}) {
            const auto made =
                tf::section(scaled, {{0, 0, scale / 4}, normal}, std::array{0.0, scale / 8});
            check_layers(made);
            CHECK(made.loops.size() == 2);
        }
    }
}

TEST_CASE("what is no plane or no mesh is refused; progress may stop it") {
    const tf::mesh box = test::box(1, 1, 1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::section(box, {{}, {0, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::section(box, {{0, nan, 0}, {0, 0, 1}}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::section(box, {{}, {0, nan, 1}}), std::invalid_argument);
    CHECK_THROWS_AS((void)at(box, nan), std::invalid_argument);
    tf::mesh bad = box;
    bad.faces[3][1] = 8;
    CHECK_THROWS_AS((void)at(bad, 0.5), std::invalid_argument);
    bad = box;
    bad.points[2].x = nan;
    CHECK_THROWS_AS((void)at(bad, 0.5), std::invalid_argument);
    CHECK(at(tf::mesh{}, 0.5).layers.size() == 1);
    CHECK(tf::section(box, {}, std::span<const double>{}).layers.empty());
    const auto stopped = tf::section(box, {}, std::array{0.5}, {[](double) { return false; }});
    CHECK(stopped.status == tf::status::cancelled);
    CHECK(stopped.layers.empty());
}
