#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <support/solid_families.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace test {
namespace {

using expression = tf::boolean_expression;

double power_of_ten(int exponent) { return std::pow(10.0, exponent); }

/// A random power of two, from 1 down to 2^-most.
double little(random& source, std::size_t most) {
    return std::ldexp(1.0, -static_cast<int>(source.below(most + 1)));
}

double whole(random& source, std::size_t below) { return static_cast<double>(source.below(below)); }

std::vector<expression> all_of_two() { return {{"a+b", 2}, {"a*b", 2}, {"a-b", 2}, {"a^b", 2}}; }

std::vector<expression> all_of(std::size_t operands) {
    return {expression::union_of(operands), expression::symmetric_difference_of(operands)};
}

tf::mesh turned_box(random& source) {
    return turned(moved(box(1, 1, 1), {-0.5, -0.5, -0.5}), random_axis(source), source.in(0, 3));
}

tf::point3 random_point(random& source, double size) {
    return {source.in(-size, size), source.in(-size, size), source.in(-size, size)};
}

tf::mesh shaken(tf::mesh mesh, random& source, double by) {
    for (tf::point3& p : mesh.points) {
        const tf::point3 d = random_point(source, by);
        p = {p.x + d.x, p.y + d.y, p.z + d.z};
    }
    return mesh;
}

solid_case turned_alike(solid_case made, random& source) {
    const tf::point3 axis = random_axis(source);
    const double angle = source.in(0, 3);
    for (tf::mesh& mesh : made.operands) mesh = turned(std::move(mesh), axis, angle);
    return made;
}

solid_case touching(std::size_t number, random& source) {
    const tf::mesh large = box(2, 2, 2);
    const auto small = [](double x, double y, double z) { return moved(box(1, 1, 1), {x, y, z}); };
    const auto beside = [&](double x, double y, double z) { return moved(large, {x, y, z}); };
    const std::array<tf::mesh, 11> others{
        beside(2, 0, 0),  // a whole face
        beside(2, 2, 0),  // a whole edge
        beside(2, 2, 2),  // a corner
        small(2, 0.5, 0.5),
        beside(2, 1, 1),
        beside(2, 2, 1),
        small(0.5, 0.5, 0.5),
        small(0, 0.5, 0.5),
        large,
        moved(turned(moved(large, {-1, -1, 0}), {0, 0, 1}, std::atan(1.0)), {1, 1, 0}),
        beside(1, 0, 0)};
    solid_case made{{large, others[number % others.size()]}, all_of_two()};
    return number < others.size() ? made : turned_alike(std::move(made), source);
}

solid_case cubes(std::size_t, random& source) {
    return {{turned_box(source), moved(turned_box(source), random_point(source, 0.8))},
            all_of_two()};
}

tf::mesh tetrahedron(std::array<tf::point3, 4> p) {
    if (tf::orient3d(p[0], p[1], p[2], p[3]) < 0) std::swap(p[0], p[1]);
    return {{p.begin(), p.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

solid_case tetrahedra(std::size_t number, random& source) {
    const bool on_lattice = source.below(2) == 0;
    const auto point = [&] {
        if (!on_lattice) return random_point(source, 1);
        return tf::point3{whole(source, 7), whole(source, 7), whole(source, 7)};
    };
    std::array<tf::point3, 4> p{point(), point(), point(), point()};
    std::array<tf::point3, 4> q{point(), point(), point(), point()};
    for (std::size_t k = 0; k < 1 + number % 3; ++k) q[k] = p[k];
    return {{tetrahedron(p), tetrahedron(q)}, all_of_two()};
}

/// What is below a height above each corner of a grid of side x side squares, down to -1.
template <class Height>
tf::mesh landscape(std::uint32_t side, const Height& height) {
    const tf::mesh sheet = grid(side);
    tf::mesh top = sheet;
    const tf::mesh bottom = inside_out(moved(sheet, {0, 0, -1}));
    for (tf::point3& p : top.points) p.z = height(p.x, p.y);
    const auto under = static_cast<std::uint32_t>(sheet.points.size());
    tf::mesh solid = together(std::move(top), bottom);
    const auto wall = [&](std::uint32_t a, std::uint32_t b) {
        solid.faces.push_back({a, a + under, b + under});
        solid.faces.push_back({a, b + under, b});
    };
    const std::uint32_t row = side + 1, last = side * row;
    for (std::uint32_t i = 0; i < side; ++i) {
        wall(i, i + 1);
        wall(last + i + 1, last + i);
        wall((i + 1) * row, i * row);
        wall(i * row + side, (i + 1) * row + side);
    }
    return solid;
}

solid_case grids(std::size_t number, random& source) {
    const tf::mesh slab = landscape(8, [](double, double) { return 0.0; });
    const double angle = power_of_ten(-4 - static_cast<int>(number % 13));
    return {{slab, turned(slab, random_axis(source), angle)}, all_of_two()};
}

solid_case balls(std::size_t number, random&) {
    const tf::mesh still = ball(2, 1.0);
    const int step = static_cast<int>(number % 16);
    if (step < 13) return {{still, moved(still, {power_of_ten(-3 - step), 0, 0})}, all_of_two()};
    tf::mesh next = still;
    for (int ulps = 13; ulps <= step; ++ulps)
        for (tf::point3& p : next.points) p.x = std::nextafter(p.x, 9.0);
    return {{still, next}, all_of_two()};
}

solid_case sizes(std::size_t number, random& source) {
    const double by = power_of_ten(static_cast<int>(number * 7 % 61) - 30);
    const tf::mesh cube = moved(turned_box(source), random_point(source, 0.5));
    return {{scaled(ball(1, 1.0), by), scaled(cube, by)}, all_of_two()};
}

solid_case offsets(std::size_t number, random& source) {
    const double far = power_of_ten(static_cast<int>(number % 10));
    const tf::point3 by = random_point(source, far);
    return {{moved(ball(1, 1.0), by), moved(turned_box(source), by)}, all_of_two()};
}

solid_case menger(std::size_t number, random& source) {
    const int levels = number % 8 == 0 ? 2 : 1;
    const double side = std::pow(3.0, levels);
    std::vector<tf::mesh> solids{box(side, side, side)};
    for (int level = 1; level <= levels; ++level) {
        const double hole = side / std::pow(3.0, level);
        for (double u = hole; u < side; u += 3.0 * hole)
            for (double v = hole; v < side; v += 3.0 * hole)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    tf::mesh rod = box(hole, hole, side + 2.0);
                    for (tf::point3& p : rod.points) {
                        const std::array<double, 3> q{p.x + u, p.y + v, p.z - 1.0};
                        p = {q[axis], q[(axis + 1) % 3], q[(axis + 2) % 3]};
                    }
                    solids.push_back(std::move(rod));
                }
    }
    const expression without = expression::difference_of(solids.size());
    solid_case made{std::move(solids), {without}};
    return levels == 2 ? made : turned_alike(std::move(made), source);
}

solid_case pencils(std::size_t number, random& source) {
    solid_case made;
    for (std::size_t k = 0, count = 3 + source.below(9); k < count; ++k) {
        const double from = source.in(0, 6.28), to = from + source.in(0.1, 1.5);
        made.operands.push_back(tetrahedron({tf::point3{0, 0, -1}, tf::point3{0, 0, 1},
                                             tf::point3{std::cos(from), std::sin(from), 0.1},
                                             tf::point3{std::cos(to), std::sin(to), -0.1}}));
    }
    made.asked = all_of(made.operands.size());
    return number % 2 == 0 ? made : turned_alike(std::move(made), source);
}

solid_case bricks(std::size_t, random& source) {
    solid_case made;
    for (std::size_t k = 0, count = 12 + source.below(19); k < count; ++k)
        made.operands.push_back(moved(box(1 + whole(source, 2), 1, 1),
                                      {whole(source, 6) / 2, whole(source, 4), whole(source, 5)}));
    made.asked = all_of(made.operands.size());
    return turned_alike(std::move(made), source);
}

solid_case noise(std::size_t, random& source) {
    solid_case made;
    const double amplitude = little(source, 45);
    for (std::size_t k = 0, count = 2 + source.below(3); k < count; ++k)
        made.operands.push_back(
            landscape(6, [&](double, double) { return amplitude * source.unit(); }));
    made.asked = all_of(made.operands.size());
    made.asked.push_back(expression::intersection_of(made.operands.size()));
    return source.below(2) == 0 ? made : turned_alike(std::move(made), source);
}

solid_case plates(std::size_t, random& source) {
    solid_case made;
    const tf::point3 axis = random_axis(source);
    for (std::size_t k = 0, count = 2 + source.below(5); k < count; ++k) {
        const tf::mesh plate = box(1, 1, little(source, 50));
        made.operands.push_back(turned(plate, axis, source.in(-1, 1) * little(source, 30)));
    }
    made.asked = all_of(made.operands.size());
    return made;
}

solid_case copies(std::size_t number, random& source) {
    solid_case made;
    const tf::mesh still = ball(2 + static_cast<int>(number % 2), 1.0);
    for (int k = 0; k < 3; ++k)
        made.operands.push_back(shaken(still, source, 0x1p-20 * little(source, 33)));
    made.asked = all_of(made.operands.size());
    return made;
}

solid_case ulps(std::size_t, random& source) {
    solid_case made;
    const tf::mesh still = turned_box(source);
    const tf::point3 axis = random_axis(source);
    for (int k = 0; k < 4; ++k) {
        const double angle = source.in(-1, 1) * 0x1p-52 * whole(source, 8);
        made.operands.push_back(moved(turned(still, axis, angle), {k * 0.25, 0, 0}));
    }
    made.asked = all_of(made.operands.size());
    return made;
}

solid_case heaps(std::size_t number, random& source) {
    tf::mesh heap;
    for (int k = 0; k < 6; ++k)
        heap = together(std::move(heap), number % 2 == 0
                                             ? shaken(lattice_box(source), source, 0x1p-51)
                                             : moved(ball(2, 1.0), random_point(source, 0.5)));
    return {{heap, number % 2 == 0 ? box(2, 2, 2) : ball(2, 0.7)}, all_of_two()};
}

}  // namespace

tf::point3 random_axis(random& source) {
    for (;;) {
        const tf::point3 p = random_point(source, 1);
        const double square = p.x * p.x + p.y * p.y + p.z * p.z;
        if (square > 0.01 && square <= 1.0) return p;
    }
}

std::span<const solid_family> solid_families() {
    static constexpr std::array<solid_family, 15> families{{{"touching", touching},
                                                            {"cubes", cubes},
                                                            {"tetrahedra", tetrahedra},
                                                            {"grids", grids},
                                                            {"balls", balls},
                                                            {"sizes", sizes},
                                                            {"offsets", offsets},
                                                            {"menger", menger},
                                                            {"pencils", pencils},
                                                            {"bricks", bricks},
                                                            {"noise", noise},
                                                            {"plates", plates},
                                                            {"copies", copies},
                                                            {"ulps", ulps},
                                                            {"heaps", heaps}}};
    return families;
}

}  // namespace test
