#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace {

/// Tetrahedra on some points of a small lattice, either way round: they overlap, share corners,
/// edges and parts of faces, and are closed as a whole.
tf::mesh tetrahedra(test::random& random, std::size_t count, std::size_t points, std::size_t side) {
    tf::mesh m = test::lattice_soup(random, 0, points, side);
    const auto any = [&] { return static_cast<std::uint32_t>(random.below(points)); };
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t a = any(), b = any(), c = any(), d = any();
        m.faces.insert(m.faces.end(), {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}});
    }
    return m;
}

/// Operands in one mesh, equal points being one.
struct scene {
    std::vector<tf::mesh> operands;
    tf::mesh mesh;
    std::vector<std::uint32_t> operand_of_face;

    explicit scene(std::vector<tf::mesh> meshes) : operands(std::move(meshes)) {
        std::uint32_t k = 0;
        for (const tf::mesh& m : operands) {
            mesh = test::together(mesh, m);
            operand_of_face.resize(mesh.faces.size(), k++);
        }
        std::map<std::array<double, 3>, std::uint32_t> first;
        std::vector<std::uint32_t> number;
        for (const tf::point3& p : mesh.points)
            number.push_back(
                first.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(number.size()))
                    .first->second);
        for (tf::face& f : mesh.faces)
            for (std::uint32_t& corner : f) corner = number[corner];
    }
};

tf::point3 any_point(test::random& random, double low, double high) {
    return {random.in(low, high), random.in(low, high), random.in(low, high)};
}

/// The cell of a point at random, by the first face of the rounded arrangement along +x: for nearly
/// all points that is also the first of the exact one.
std::uint32_t cell_at(const tf::mesh& rounded, const tf::arrangement_cells& cells,
                      const tf::point3& q) {
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t cell = 0;
    for (std::size_t f = 0; f < rounded.faces.size(); ++f) {
        const tf::point3& a = rounded.points[rounded.faces[f][0]];
        const tf::point3& b = rounded.points[rounded.faces[f][1]];
        const tf::point3& c = rounded.points[rounded.faces[f][2]];
        const int sign = tf::orient2d(0, a, b, c);
        if (sign == 0 || tf::orient2d(0, a, b, q) != sign || tf::orient2d(0, b, c, q) != sign ||
            tf::orient2d(0, c, a, q) != sign)
            continue;
        const tf::point3 u{b.x - a.x, b.y - a.y, b.z - a.z};
        const tf::point3 v{c.x - a.x, c.y - a.y, c.z - a.z};
        const tf::point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double x = a.x - (n.y * (q.y - a.y) + n.z * (q.z - a.z)) / n.x;
        if (x <= q.x || x >= nearest) continue;
        nearest = x;
        cell = cells.cell_of_side[f][sign > 0 ? 1 : 0];
    }
    return cell;
}

/// Compares the windings of cells with those of points in them. Returns how many of these are not
/// outside everything.
std::size_t check_windings(test::random& random, const scene& s, double low, double high) {
    const tf::mesh_arrangement cut = tf::arrange_faces(s.mesh).cut;
    const auto cells = tf::find_cells(s.mesh, cut, s.operand_of_face, s.operands.size());
    REQUIRE(cells.open_count == 0);
    tf::mesh rounded{cut.given_points, cut.faces};
    for (const auto& p : cut.constructed) rounded.points.push_back(tf::rounded(p));
    std::size_t inside = 0;
    std::vector<tf::point3> points;
    for (int i = 0; i < 100; ++i) points.push_back(any_point(random, low, high));
    for (std::size_t k = 0; k < s.operands.size(); ++k) {
        const auto tree = tf::build_face_tree(s.operands[k]);
        const auto found = tf::detail::intersect::point_locator(s.operands[k], tree).locate(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            CAPTURE(i);
            const std::uint32_t cell = cell_at(rounded, cells, points[i]);
            CHECK(cells.winding_of(cell)[k] == found[i].winding);
            inside += found[i].winding != 0 ? 1 : 0;
        }
    }
    for (const unsigned threads : {1U, 8U}) {
        const tf::thread_scope scope(threads);
        const auto again = tf::find_cells(s.mesh, cut, s.operand_of_face, s.operands.size());
        CHECK(again.cell_of_side == cells.cell_of_side);
        CHECK(again.winding == cells.winding);
    }
    return inside;
}

TEST_CASE("cells of solids: agree with points located in heaps of tetrahedra on a lattice") {
    std::size_t inside = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        std::vector<tf::mesh> operands;
        for (std::size_t k = 1 + random.below(3); k > 0; --k)
            operands.push_back(tetrahedra(random, 1 + random.below(6), 6 + random.below(6), 5));
        inside += check_windings(random, scene(operands), 0, 4);
    }
    CHECK(inside > 500);
}

TEST_CASE("cells of solids: agree with points located in balls and boxes that cross") {
    std::size_t inside = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        std::vector<tf::mesh> operands;
        for (std::size_t k = 2 + random.below(3); k > 0; --k) {
            tf::mesh m = random.below(2) == 0
                             ? test::ball(static_cast<int>(random.below(3)), random.in(0.5, 1.5))
                             : test::box(1, random.in(0.5, 2), 2);
            m = test::moved(m, any_point(random, -1, 1));
            if (random.below(4) == 0)  // with a hollow, and twice in places
                m = test::together(m, test::scaled(test::ball(1, 1.0), 0.25));
            operands.push_back(m);
        }
        inside += check_windings(random, scene(operands), -2, 2);
    }
    CHECK(inside > 500);
}

TEST_CASE("cells of solids: a small one in a hole of a large one, whose faces it cuts, is placed") {
    // Rods through a plate: their ends are on both sides of it, and the plate is in many pieces.
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random random(seed);
        tf::mesh rods, balls;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                const tf::point3 at{0, 1.0 * i + random.in(0, 0.2), 1.0 * j + random.in(0, 0.2)};
                rods = test::together(rods, test::moved(test::box(0.9 + 0.2 * (i % 2), 0.5, 0.5),
                                                        {at.x - 0.8, at.y, at.z}));
                balls = test::together(
                    balls, test::moved(test::ball(1, 0.1), {at.x - 0.5, at.y + 0.25, at.z + 0.25}));
            }
        const tf::mesh plate = test::moved(test::box(0.3, 4, 4), {-0.1, -0.1, -0.1});
        CHECK(check_windings(random, scene({plate, rods, balls}), -1, 4) > 0);
    }
}

}  // namespace
