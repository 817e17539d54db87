#include <libmesh/arrange/cells.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solid_complex.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using test::complex;
using test::field;
using test::lattice;
using test::operands;
using test::placed;
using test::same_way;
using test::shape;
using test::sorted;
using test::surfaces;
using test::wall;
using test::walls_of;
using test::winding;

operands join(const std::vector<tf::mesh>& meshes) {
    operands result;
    for (const tf::mesh& m : meshes) {
        result.mesh = test::together(result.mesh, m);
        result.of_face.resize(result.mesh.faces.size(), static_cast<std::uint32_t>(result.count++));
    }
    return result;
}

/// Gives equal points the lowest of their numbers.
operands with_equal_points_joined(operands all) {
    std::map<std::array<double, 3>, std::uint32_t> first;
    std::vector<std::uint32_t> number;
    for (const tf::point3& p : all.mesh.points)
        number.push_back(
            first.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(number.size()))
                .first->second);
    for (tf::face& f : all.mesh.faces)
        for (std::uint32_t& corner : f) corner = number[corner];
    return all;
}

/// The arrangement of faces that meet in corners, edges or as a whole: equal ones become one.
tf::mesh_arrangement arrangement_of(const tf::mesh& mesh) {
    tf::mesh_arrangement cut;
    cut.given_points = mesh.points;
    std::map<std::array<std::uint32_t, 3>, std::size_t> number;
    std::vector<std::vector<tf::covering_face>> covers;
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        const auto [at, added] = number.try_emplace(sorted(mesh.faces[i]), cut.faces.size());
        if (added) {
            cut.faces.push_back(mesh.faces[i]);
            covers.emplace_back();
        }
        covers[at->second].push_back({i, !same_way(cut.faces[at->second], mesh.faces[i])});
    }
    cut.cover_begin.push_back(0);
    for (const auto& list : covers) {
        cut.covers.insert(cut.covers.end(), list.begin(), list.end());
        cut.cover_begin.push_back(cut.covers.size());
    }
    return cut;
}

tf::arrangement_cells cells_of(const operands& all) {
    return tf::find_cells(all.mesh, arrangement_of(all.mesh), all.of_face, all.count);
}

bool same_cells(const tf::arrangement_cells& a, const tf::arrangement_cells& b) {
    return a.cell_of_side == b.cell_of_side && a.winding == b.winding && a.open == b.open &&
           a.open_count == b.open_count;
}

/// What the fields of many tests had in them, lest they be too simple.
struct coverage {
    std::size_t cells = 0;
    std::size_t hollows = 0;  ///< cells that no operand winds around, other than the unbounded one
    int most = 0;
};

/// Checks cells against the solids: the same parts of space, with the windings they were to have.
void check_cells(const complex& c, const std::vector<wall>& walls, const field& w,
                 const operands& all, coverage& seen) {
    const tf::mesh_arrangement cut = arrangement_of(all.mesh);
    const tf::arrangement_cells cells = tf::find_cells(all.mesh, cut, all.of_face, all.count);
    REQUIRE(cells.open_count == 0);
    REQUIRE(cells.cell_of_side.size() == cut.faces.size());

    const std::size_t outside = c.solids.size();
    std::vector<std::size_t> region(outside + 1);
    std::iota(region.begin(), region.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (region[i] != i) i = region[i] = region[region[i]];
        return i;
    };
    std::map<std::array<std::uint32_t, 3>, const wall*> wall_at;
    for (const wall& s : walls) {
        wall_at[sorted(s.face)] = &s;
        bool open = true;
        for (std::size_t k = 0; k < w.size(); ++k)
            open &= winding(w, k, s.front) == winding(w, k, s.behind);
        if (open) region[root(s.front)] = root(s.behind);
    }

    std::map<std::size_t, std::uint32_t> cell_of{{root(outside), 0}};
    std::vector<std::size_t> solid_of{outside};
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const wall& s = *wall_at.at(sorted(cut.faces[f]));
        std::array sides{s.front, s.behind};
        if (!same_way(s.face, cut.faces[f])) std::swap(sides[0], sides[1]);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto next = static_cast<std::uint32_t>(cell_of.size());
            const auto [at, added] = cell_of.try_emplace(root(sides[k]), next);
            REQUIRE(cells.cell_of_side[f][k] == at->second);
            if (added) solid_of.push_back(sides[k]);
        }
    }
    REQUIRE(cells.winding.size() == cell_of.size() * w.size());
    for (std::uint32_t i = 0; i < solid_of.size(); ++i) {
        bool hollow = i > 0;
        for (std::size_t k = 0; k < w.size(); ++k) {
            const int expected = winding(w, k, solid_of[i]);
            REQUIRE(cells.winding_of(i)[k] == expected);
            hollow &= expected == 0;
            seen.most = std::max(seen.most, std::abs(expected));
        }
        seen.hollows += hollow ? 1 : 0;
    }
    seen.cells += cell_of.size();
}

/// Windings at random: of single tetrahedra, whole cubes, or shells within shells; `density` in
/// ten are not 0.
field random_field(test::random& random, std::uint32_t side, std::size_t operands,
                   std::size_t density) {
    const auto any = [&] {
        if (random.below(10) >= density) return 0;
        return random.below(4) == 0 ? static_cast<int>(random.below(5)) - 2 : 1;
    };
    field w(operands);
    const std::size_t cubes = std::size_t{side} * side * side;
    for (auto& of_solid : w) {
        const std::size_t kind = random.below(4);
        std::vector<int> shell(side);
        for (int& x : shell) x = any();
        for (std::size_t cube = 0; cube < cubes; ++cube) {
            const std::array at{cube % side, cube / side % side, cube / side / side};
            std::size_t depth = side;
            for (const std::size_t x : at) depth = std::min({depth, x, side - 1 - x});
            const int whole = kind == 1 ? any() : shell[depth];
            for (int i = 0; i < 6; ++i)
                of_solid.push_back(kind == 0 || (kind == 3 && random.below(8) == 0) ? any()
                                                                                    : whole);
        }
    }
    return w;
}

TEST_CASE("cells: are the parts of space between solids of a lattice, wound around as these say") {
    coverage seen;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        const auto side = static_cast<std::uint32_t>(1 + random.below(4));
        const auto how = static_cast<shape>(random.below(5));
        const complex c = placed(random, lattice(side), how);
        const auto walls = walls_of(c);
        const field w = random_field(random, side, 1 + random.below(3), 1 + random.below(9));
        const operands all = surfaces(random, c, walls, w, random.below(2) == 0);
        check_cells(c, walls, w, all, seen);
    }
    CHECK(seen.cells > 1000);
    CHECK(seen.hollows > 50);
    CHECK(seen.most == 2);
}

TEST_CASE("cells: shells within shells are found in each other, however the lattice lies") {
    coverage seen;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        const complex c = placed(random, lattice(9), static_cast<shape>(seed % 5));
        const auto walls = walls_of(c);
        field w(2);
        for (std::size_t i = 0; i < 9 * 9 * 9 * 6; ++i) {
            const std::size_t cube = i / 6;
            std::size_t depth = 9;
            for (const std::size_t x : {cube % 9, cube / 9 % 9, cube / 81})
                depth = std::min({depth, x, 8 - x});
            w[0].push_back(depth % 2 == 0 ? 1 : 0);
            w[1].push_back(depth >= 2 && cube % 9 != 4 ? -1 : 0);
        }
        check_cells(c, walls, w, surfaces(random, c, walls, w, true), seen);
    }
    CHECK(seen.hollows >= 10);
}

/// Tetrahedra about the edge from (0, 0, 0) to (0, 0, 1), between neighboring half-planes through
/// points of the plane z = 0 whose coordinates are at most `size`, at random or close together.
complex fan(test::random& random, std::size_t rays, std::size_t size, bool close) {
    complex c;
    c.points = {{0, 0, 0}, {0, 0, 1}};
    const auto any = [&] {
        return static_cast<double>(random.below(2 * size + 1)) - static_cast<double>(size);
    };
    std::vector<tf::point3> ring{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    while (ring.size() < rays) {
        tf::point3 p{any(), any(), 0};
        if (close && random.below(2) == 0) {
            p = ring[random.below(ring.size())];
            p = {p.x * static_cast<double>(size) + 1, p.y * static_cast<double>(size) - 1, 0};
        }
        const double far = std::max(std::abs(p.x), std::abs(p.y));
        if (far != 0 && far < 0x1p+48) ring.push_back(p);  // exact, also when sheared
    }
    const auto half = [](const tf::point3& p) { return p.y > 0 || (p.y == 0 && p.x > 0) ? 0 : 1; };
    const auto before = [&](const tf::point3& p, const tf::point3& q) {
        if (half(p) != half(q)) return half(p) < half(q);
        return tf::orient2d(2, {0, 0, 0}, p, q) > 0;
    };
    std::sort(ring.begin(), ring.end(), before);
    ring.erase(std::unique(ring.begin(), ring.end(),
                           [&](const auto& p, const auto& q) { return !before(p, q); }),
               ring.end());
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
        c.points.push_back(ring[i]);
        const auto next = static_cast<std::uint32_t>((i + 1) % ring.size());
        c.solids.push_back({0, 1, i + 2, next + 2});
    }
    return c;
}

TEST_CASE("cells: many solids about one edge are told apart, however small their angles") {
    coverage seen;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        const std::size_t size = std::array<std::size_t, 3>{5, 1000, 1U << 26}[seed % 3];
        const complex straight = fan(random, 4 + random.below(seed % 7 == 0 ? 200 : 20), size,
                                     seed % 2 == 0 && size < 2000);
        const complex c =
            placed(random, straight, seed % 4 == 0 ? shape::straight : shape::sheared);
        const auto walls = walls_of(c);
        field w(2);
        for (auto& of_solid : w)
            for (std::size_t i = 0; i < c.solids.size(); ++i)
                of_solid.push_back(static_cast<int>(random.below(3)) - 1);
        check_cells(c, walls, w, surfaces(random, c, walls, w, seed % 3 != 0), seen);
    }
    CHECK(seen.cells > 1000);
}

TEST_CASE("cells: no faces leave the unbounded cell, around which nothing winds") {
    const tf::arrangement_cells cells =
        tf::find_cells({}, arrangement_of({}), std::vector<std::uint32_t>{}, 3);
    CHECK(cells.cell_of_side.empty());
    CHECK(cells.winding == std::vector<std::int32_t>{0, 0, 0});
    CHECK(cells.open_count == 0);
}

TEST_CASE("cells: a box has one inside, wound around once, and its mirror image once less") {
    const operands all = join({test::box(1, 1, 1)});
    const tf::arrangement_cells cells = cells_of(all);
    for (const auto& [front, behind] : cells.cell_of_side) {
        CHECK(front == 0);
        CHECK(behind == 1);
    }
    CHECK(cells.winding == std::vector<std::int32_t>{0, 1});
    operands inward = all;
    for (tf::face& f : inward.mesh.faces) std::swap(f[0], f[1]);
    CHECK(cells_of(inward).winding == std::vector<std::int32_t>{0, -1});
}

/// Windings of all cells, however these are numbered.
std::multiset<std::vector<std::int32_t>> windings(const tf::arrangement_cells& cells) {
    std::multiset<std::vector<std::int32_t>> rows;
    for (std::uint32_t c = 0; c * cells.operands < cells.winding.size(); ++c) {
        const auto row = cells.winding_of(c);
        rows.emplace(row.begin(), row.end());
    }
    return rows;
}

TEST_CASE("cells: a point that no face has changes nothing, wherever it is, finite or not") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh box = test::box(1, 1, 1);
    const std::vector<std::uint32_t> one_operand(box.faces.size(), 0);
    const auto expected = tf::find_cells(box, arrangement_of(box), one_operand, 1);
    REQUIRE(expected.winding == std::vector<std::int32_t>{0, 1});
    for (const tf::point3& p : std::vector<tf::point3>{
             {5, 0, 0}, {-5, 0, 0}, {1, 1, 1}, {infinity, 0, 0}, {nan, nan, nan}, {5, nan, 0}}) {
        for (const std::size_t place : {std::size_t{0}, std::size_t{3}, box.points.size()}) {
            tf::mesh more = box;
            more.points.insert(more.points.begin() + static_cast<std::ptrdiff_t>(place), p);
            for (tf::face& f : more.faces)
                for (std::uint32_t& corner : f) corner += corner >= place ? 1 : 0;
            CHECK(same_cells(tf::find_cells(more, arrangement_of(more), one_operand, 1), expected));
        }
    }
}

TEST_CASE("cells: operands are told apart whatever their numbers") {
    const tf::mesh box = test::box(1, 1, 1);
    for (const std::uint32_t low : {0U, 253U, 254U, 255U, 256U, 300U}) {
        CAPTURE(low);
        std::vector<std::uint32_t> operand(box.faces.size(), low);
        const auto closed = tf::find_cells(box, arrangement_of(box), operand, low + 2);
        REQUIRE(closed.open_count == 0);
        REQUIRE(closed.winding.size() == 2 * (low + 2));
        CHECK(closed.winding_of(1)[low] == 1);
        CHECK(closed.winding_of(1)[low + 1] == 0);
        operand.back() = low + 1;  // alone, and missing from the other one
        const auto open = tf::find_cells(box, arrangement_of(box), operand, low + 2);
        CHECK(open.open_count == 6);  // three edges of both
        for (const auto& edge : open.open) CHECK((edge.operand == low || edge.operand == low + 1));
    }
}

TEST_CASE("cells: boxes that share a face, an edge, a corner or nothing have an inside each") {
    using rows = std::multiset<std::vector<std::int32_t>>;
    for (const tf::point3& by : std::vector<tf::point3>{
             {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 2, 2}, {0, 2, 0}, {-1, 1, 0}, {-1, -1, 1}}) {
        const operands all = with_equal_points_joined(
            join({test::box(1, 1, 1), test::moved(test::box(1, 1, 1), by)}));
        CHECK(windings(cells_of(all)) == rows{{0, 0}, {0, 1}, {1, 0}});
    }
    const operands same = with_equal_points_joined(join({test::box(1, 1, 1), test::box(1, 1, 1)}));
    CHECK(windings(cells_of(same)) == rows{{0, 0}, {1, 1}});
    CHECK(cells_of(same).cell_of_side.size() == 12);
}

TEST_CASE("cells: a ball in a ball is inside, and makes it hollow when turned inside out") {
    using rows = std::multiset<std::vector<std::int32_t>>;
    const tf::mesh large = test::ball(2, 3.0);
    tf::mesh small = test::ball(1, 1.0);
    CHECK(windings(cells_of(join({large, small}))) == rows{{0, 0}, {1, 0}, {1, 1}});
    for (tf::face& f : small.faces) std::swap(f[0], f[1]);
    operands one = join({large, small});
    one.of_face.assign(one.of_face.size(), 0);
    one.count = 1;
    const tf::arrangement_cells cells = cells_of(one);
    CHECK(cells.winding == std::vector<std::int32_t>{0, 1, 0});
    CHECK(cells.cell_of_side.front() == std::array<std::uint32_t, 2>{0, 1});
    CHECK(cells.cell_of_side.back() == std::array<std::uint32_t, 2>{2, 1});
    CHECK(windings(cells_of(join({large, test::moved(test::ball(1, 1.0), {9, 0, 0})}))) ==
          rows{{0, 0}, {0, 1}, {1, 0}});
}

TEST_CASE("cells: faces that cancel out bound nothing, wherever they are") {
    const tf::mesh box = test::box(4, 4, 4);
    for (const tf::point3& at :
         std::vector<tf::point3>{{2, 2, 2}, {9, 1, 1}, {-9, 1, 1}, {1, 9, 9}}) {
        operands all = join({box});
        all.mesh.points.insert(
            all.mesh.points.end(),
            {at, {at.x - 1, at.y, at.z}, {at.x - 1, at.y, at.z - 1}, {at.x - 1, at.y - 1, at.z}});
        for (const tf::face& f : {tf::face{8, 9, 10}, {10, 9, 8}, {9, 10, 11}, {9, 11, 10}}) {
            all.mesh.faces.push_back(f);  // the first two in a plane y = const
            all.of_face.push_back(0);
        }
        const tf::arrangement_cells cells = cells_of(all);
        CHECK(cells.winding == std::vector<std::int32_t>{0, 1});
        const std::uint32_t where = at == tf::point3{2, 2, 2} ? 1 : 0;
        CHECK(cells.cell_of_side[12] == std::array{where, where});
        CHECK(cells.cell_of_side[13] == std::array{where, where});
    }
}

TEST_CASE("cells: where an operand is open, its edges are named and nothing else is told") {
    operands all = with_equal_points_joined(join({test::box(1, 1, 1), test::box(1, 1, 1)}));
    all.mesh.faces.erase(all.mesh.faces.begin() + 15);  // 5, 7, 6 of the second
    all.of_face.pop_back();
    const tf::arrangement_cells cells = cells_of(all);
    CHECK(cells.open_count == 3);
    const std::vector<tf::open_arrangement_edge> expected{
        {1, {5, 6}, 14}, {1, {5, 7}, 22}, {1, {6, 7}, 18}};
    CHECK(cells.open == expected);
    CHECK(cells.cell_of_side.empty());
    CHECK(cells.winding.empty());

    const tf::mesh sheet = test::grid(200);
    const tf::arrangement_cells many = cells_of(join({sheet, test::box(1, 1, 1)}));
    CHECK(many.open_count == 800);
    REQUIRE(many.open.size() == 100);
    for (std::size_t i = 1; i < many.open.size(); ++i)
        CHECK(many.open[i - 1].points < many.open[i].points);
    // Two operands that make up a closed surface between them.
    operands halves = join({test::box(1, 1, 1)});
    halves.count = 2;
    halves.of_face.back() = 1;
    const tf::arrangement_cells split = cells_of(halves);
    CHECK(split.open_count == 6);
    CHECK(split.open[0].points == split.open[1].points);
    CHECK(split.open[0].operand == 0);
    CHECK(split.open[1].operand == 1);
}

TEST_CASE("cells: are the same on any number of threads") {
    test::random random(7);
    const complex c = placed(random, lattice(16), shape::uneven);
    const auto walls = walls_of(c);
    field w = random_field(random, 16, 2, 2);
    for (auto& of_solid : w)
        for (int& x : of_solid)
            if (x == 0) x = random.below(20) == 0 ? 1 : 0;
    const operands all = surfaces(random, c, walls, w, true);
    const tf::mesh_arrangement cut = arrangement_of(all.mesh);
    const tf::arrangement_cells cells = tf::find_cells(all.mesh, cut, all.of_face, all.count);
    CHECK(cells.winding.size() > 1000);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(same_cells(tf::find_cells(all.mesh, cut, all.of_face, all.count), cells));
    }
}

TEST_CASE("cells: what is no arrangement is refused") {
    const operands box = join({test::box(1, 1, 1)});
    const tf::mesh_arrangement cut = arrangement_of(box.mesh);
    CHECK_THROWS_WITH_AS(static_cast<void>(tf::find_cells(box.mesh, cut, box.of_face, 0)),
                         "treeform::find_cells: face 0 has an operand out of range",
                         std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::find_cells({}, cut, box.of_face, 1)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::find_cells(box.mesh, cut, {}, 1)), std::invalid_argument);
    tf::mesh_arrangement wild = cut;
    wild.faces[3][1] = 8;
    CHECK_THROWS_AS(static_cast<void>(tf::find_cells(box.mesh, wild, box.of_face, 1)),
                    std::invalid_argument);
    wild = cut;
    wild.covers[3].face = 12;
    CHECK_THROWS_AS(static_cast<void>(tf::find_cells(box.mesh, wild, box.of_face, 1)),
                    std::invalid_argument);
    // Two tetrahedra at one edge, with faces that lie on each other in part.
    operands both;
    both.count = 1;
    both.mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 2, 0}, {0, 0, -1}};
    both.mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                       {0, 1, 4}, {1, 0, 5}, {4, 1, 5}, {0, 4, 5}};
    both.of_face.assign(8, 0);
    CHECK_THROWS_WITH_AS(
        static_cast<void>(cells_of(both)),
        "treeform::find_cells: faces lie on each other at the edge between points 0 and 1",
        std::logic_error);
}

}  // namespace
