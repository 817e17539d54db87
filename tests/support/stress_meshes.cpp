#include "support/stress_meshes.hpp"

#include "support/stress_parts.hpp"
#include "support/stress_placement.hpp"
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace treeform::test {
namespace {

using namespace stress;

// --- parts ---

/// The largest whole number whose `power`-th power is at most n; at least 1.
std::size_t root(std::size_t n, int power) {
    const auto raised = [&](std::size_t x) {
        std::size_t product = x;
        for (int i = 1; i < power; ++i) product *= x;
        return product;
    };
    std::size_t x = 1;
    while (raised(x + 1) <= n) ++x;
    return x;
}

void add(mesh& to, const mesh& shape) {
    const auto offset = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), shape.points.begin(), shape.points.end());
    for (const face& f : shape.faces)
        to.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
}

/// With corners of its own.
void add(mesh& to, const triangle3& t) { add(to, {{t.begin(), t.end()}, {{0, 1, 2}}}); }

void add_box(mesh& to, const point3& low, const point3& high) {
    mesh box;
    for (int i = 0; i < 8; ++i)
        box.points.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                              (i & 4) != 0 ? high.z : low.z});
    box.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    add(to, box);
}

void add_tetrahedron(mesh& to, const std::array<point3, 4>& p) {
    add(to, {{p.begin(), p.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
}

triangle3 corners_of(const mesh& m, const face& f) {
    return {m.points[f[0]], m.points[f[1]], m.points[f[2]]};
}

template <class Change>
mesh changed(mesh shape, Change change) {
    for (point3& p : shape.points) p = change(p);
    return shape;
}

/// `side` x `side` squares of the unit square in two triangles each; `lift` makes points of them.
template <class Lift>
mesh sheet(std::size_t side, Lift lift) {
    mesh made;
    const auto n = static_cast<std::uint32_t>(side);
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            made.points.push_back(lift(static_cast<double>(x) / n, static_cast<double>(y) / n));
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t at = y * (n + 1) + x;
            const std::uint32_t up = at + n + 1;
            made.faces.push_back({at, at + 1, up + 1});
            made.faces.push_back({at, up + 1, up});
        }
    return made;
}

/// A sheet whose heights are random, within a square's width.
mesh bumpy_sheet(std::size_t side, random_source& random) {
    return sheet(side, [&](double u, double v) {
        return point3{u, v, random.unit() / static_cast<double>(side)};
    });
}

/// An octahedron, each face cut in side^2, its corners pushed out to the unit sphere.
mesh sphere(std::size_t faces) {
    const auto side = static_cast<int>(root(std::max<std::size_t>(faces / 8, 1), 2));
    mesh soup;
    for (int octant = 0; octant < 8; ++octant) {
        const point3 sign{(octant & 1) != 0 ? -1.0 : 1.0, (octant & 2) != 0 ? -1.0 : 1.0,
                          (octant & 4) != 0 ? -1.0 : 1.0};
        const auto at = [&](int i, int j) {
            const point3 p{static_cast<double>(i), static_cast<double>(j),
                           static_cast<double>(side - i - j)};
            const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
            return point3{sign.x * p.x / length, sign.y * p.y / length, sign.z * p.z / length};
        };
        const auto add_face = [&](const point3& p, const point3& q, const point3& r) {
            const bool mirrored = sign.x * sign.y * sign.z < 0;
            add(soup, mirrored ? triangle3{p, r, q} : triangle3{p, q, r});
        };
        for (int i = 0; i < side; ++i)
            for (int j = 0; i + j < side; ++j) {
                add_face(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < side) add_face(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return join_equal_points(soup);
}

// --- families ---

/// A flat sheet and one that passes through it, strip by strip at a smaller angle.
mesh near_coplanar(std::size_t faces) {
    const std::size_t side = root(std::max<std::size_t>(faces / 4, 1), 2);
    mesh made = sheet(side, [](double u, double v) { return point3{u, v, 0}; });
    add(made, sheet(side, [](double u, double v) {
            const double slope = power_of_ten(-1 - static_cast<int>(15 * v));
            return point3{u, v, slope * (u - 0.4321)};
        }));
    return made;
}

/// Closed needles through a cube, 1 to 1e-12 times as wide as long.
mesh slivers(std::size_t faces, random_source& random) {
    const std::size_t count = std::max<std::size_t>(faces / 4, 1);
    const double length = 0.25 / static_cast<double>(root(count, 3));
    mesh made;
    for (std::size_t i = 0; i < count; ++i) {
        const point3 from = random_point(random);
        const double width = length * power_of_ten(-static_cast<int>(i % 13));
        const point3 along = length * lattice_point(random, 1, 8);
        add_tetrahedron(made, {from, from + along, from + width * point3{1, -1, 0},
                               from + width * point3{0, 1, -1}});
    }
    return made;
}

/// Boxes with corners on a grid of that step, in a cube that they half fill.
void add_boxes(mesh& to, std::size_t count, double step, random_source& random) {
    const auto in_unit = static_cast<int>(1 / step);
    const auto side = static_cast<int>(root(count, 3));
    for (std::size_t i = 0; i < count; ++i) {
        const point3 low = lattice_point(random, 0, side * in_unit);
        const point3 size = lattice_point(random, 1, in_unit + 1);
        add_box(to, step * low, step * (low + size));
    }
}

mesh coplanar_grid(std::size_t faces, random_source& random) {
    mesh made;
    add_boxes(made, std::max<std::size_t>(faces / 12, 1), 1.0, random);
    return made;
}

mesh cad_grid(std::size_t faces, random_source& random) {
    mesh made;
    for (const double step : {0.125, 0.1, 1e-3})
        add_boxes(made, std::max<std::size_t>(faces / 36, 1), step, random);
    return made;
}

/// Pairs of unit spheres, up to 1e12 away.
mesh large_offsets(std::size_t faces) {
    const mesh one = sphere(faces / 8);
    mesh made;
    for (const double away : {1e3, 1e6, 1e9, 1e12}) {
        add(made, changed(one, [&](const point3& p) { return p + point3{away, -away, away}; }));
        add(made, changed(one, [&](const point3& p) {
                return p + point3{away + 0.75, -away - 0.5, away + 0.25};
            }));
    }
    return made;
}

/// Spheres of radius 1e-6 to 1e6 that touch in one point.
mesh mixed_scales(std::size_t faces) {
    mesh made;
    for (int exponent = -6; exponent <= 6; exponent += 3) {
        const double radius = power_of_ten(exponent);
        add(made, changed(sphere(faces / 5), [&](const point3& p) {
                return radius * (p + point3{1, 0, 0});
            }));
    }
    return made;
}

/// Tetrahedra of few units in a row, each unit in its own; 1e300 and 2^-1074 among them.
mesh extreme_range(std::size_t faces, random_source& random) {
    mesh made;
    const std::size_t count = std::max<std::size_t>(faces / 4, 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double unit = extreme_units[i % std::size(extreme_units)];
        const double place = 4 * static_cast<double>(i / std::size(extreme_units));
        const auto corner = [&] {
            point3 p{extreme_coordinate(unit, random), extreme_coordinate(unit, random),
                     extreme_coordinate(unit, random)};
            if (place != 0) p.x += unit * place;
            return p;
        };
        add_tetrahedron(made, {corner(), corner(), corner(), corner()});
    }
    return made;
}

/// Two cones over one circle, tip to tip through half their height: two corners of all faces.
mesh fans(std::size_t faces) {
    const std::size_t quarter = std::max<std::size_t>(faces / 8, 1);
    mesh made;
    made.points = {{0, 0, 0.5}, {0, 0, -0.5}};
    for (std::size_t i = 0; i < 4 * quarter; ++i) {
        const double t = static_cast<double>(i % quarter) / static_cast<double>(quarter);
        const double w = 1 + t * t;
        const double x = (1 - t * t) / w;
        const double y = 2 * t / w;
        const std::array<point3, 4> turned{{{x, y, 0}, {-y, x, 0}, {-x, -y, 0}, {y, -x, 0}}};
        made.points.push_back(turned[i / quarter]);
    }
    const auto rim = static_cast<std::uint32_t>(4 * quarter);
    for (std::uint32_t i = 0; i < rim; ++i) {
        const std::uint32_t next = 2 + (i + 1) % rim;
        made.faces.push_back({0, 2 + i, next});
        made.faces.push_back({1, next, 2 + i});
    }
    return made;
}

/// A sphere, and each face once more: the same, turned round, or with a corner moved by an ulp.
mesh duplicates(std::size_t faces, random_source& random) {
    mesh made = sphere(faces / 2);
    const mesh once = made;
    for (const face& f : once.faces) {
        triangle3 t = corners_of(once, f);
        if (random.one_in(3)) std::swap(t[0], t[1]);
        if (random.one_in(3)) t[2] = moved_by_ulps(t[2], 1, random);
        add(made, t);
    }
    return made;
}

/// A sphere and the same turned by one ulp.
mesh one_ulp(std::size_t faces) {
    mesh made = sphere(faces / 2);
    add(made, changed(made, [](const point3& p) {
            return point3{p.x - 0x1p-52 * p.y, p.y + 0x1p-52 * p.x, p.z};
        }));
    return made;
}

/// A sphere and another within it, by 1 to 10 ulps a coordinate.
mesh thin_shells(std::size_t faces, random_source& random) {
    mesh made = sphere(faces / 2);
    add(made, changed(made, [&](point3 p) {
            const auto steps = 1 + random.below(10);
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::uint64_t i = 0; i < steps; ++i) p[axis] = std::nextafter(p[axis], 0.0);
            return p;
        }));
    return made;
}

/// Lines on a grid, each with sixteen faces through it: along an edge of theirs, or across.
mesh pencils(std::size_t faces, random_source& random) {
    constexpr std::size_t through_one = 16;
    const std::size_t lines = std::max<std::size_t>(faces / through_one, 1);
    const std::size_t side = root(lines, 2) + 1;
    mesh made;
    for (std::size_t i = 0; i < lines; ++i) {
        const point3 foot{static_cast<double>(i % side), static_cast<double>(i / side), 0};
        const auto beside = [&] { return 0x1p-4 * lattice_point(random, -7, 7); };
        for (std::size_t k = 0; k < std::min(through_one, faces); ++k) {
            const point3 on_line = foot + point3{0, 0, random.whole(0, 4) / 4};
            const point3 off = beside();
            const point3 third = foot + beside();
            if (random.one_in(2))
                add(made, triangle3{foot, foot + point3{0, 0, 1}, third});
            else
                add(made, triangle3{on_line + off, on_line - off, third});
        }
    }
    return made;
}

/// Triangles of a size that lets each meet few others.
mesh soup(std::size_t faces, random_source& random) {
    const double size = 1 / static_cast<double>(root(faces, 3));
    mesh made;
    for (std::size_t i = 0; i < faces; ++i) {
        const point3 at = random_point(random);
        add(made, stress::changed(random_triangle(random),
                                  [&](const point3& p) { return at + size * p; }));
    }
    return made;
}

/// A sheet and over each of its faces another with corners in its plane, except for an ulp.
mesh on_plane_by_ulp(std::size_t faces, random_source& random) {
    mesh made = bumpy_sheet(root(std::max<std::size_t>(faces / 4, 1), 2), random);
    const mesh below = made;
    for (const face& f : below.faces) {
        const triangle3 t = corners_of(below, f);
        const auto corner = [&] { return moved_by_ulps(point_on_plane(t, random), 1, random); };
        add(made, {corner(), corner(), corner()});
    }
    return made;
}

/// A sheet as scans and careless programs leave it: faces missing, turned round, cut at an edge of
/// a whole neighbor or written with few digits, and edges of three faces.
mesh broken_surfaces(std::size_t faces, random_source& random) {
    const mesh whole = bumpy_sheet(root(std::max<std::size_t>(faces * 2 / 5, 1), 2), random);
    mesh made{whole.points, {}};
    for (const face& f : whole.faces) {
        const triangle3 t = corners_of(whole, f);
        const point3 middle = 0.5 * (t[0] + t[1]);
        switch (random.below(16)) {
            case 0:
                break;
            case 1:
                made.faces.push_back({f[0], f[2], f[1]});
                break;
            case 2:
                add(made, {t[0], middle, t[2]});
                add(made, {middle, t[1], t[2]});
                break;
            case 3:
                add(made, stress::changed(t, with_three_digits));
                break;
            case 4:
                add(made, {t[1], t[0], middle + (t[2] - t[0])});
                [[fallthrough]];
            default:
                made.faces.push_back(f);
        }
    }
    return made;
}

}  // namespace

mesh stress_mesh(stress_family family, std::size_t faces, std::uint64_t seed) {
    random_source random(seed);
    switch (family) {
        case stress_family::near_coplanar:
            return near_coplanar(faces);
        case stress_family::slivers:
            return slivers(faces, random);
        case stress_family::coplanar_grid:
            return coplanar_grid(faces, random);
        case stress_family::cad_grid:
            return cad_grid(faces, random);
        case stress_family::large_offsets:
            return large_offsets(faces);
        case stress_family::mixed_scales:
            return mixed_scales(faces);
        case stress_family::extreme_range:
            return extreme_range(faces, random);
        case stress_family::fans:
            return fans(faces);
        case stress_family::duplicates:
            return duplicates(faces, random);
        case stress_family::one_ulp:
            return one_ulp(faces);
        case stress_family::thin_shells:
            return thin_shells(faces, random);
        case stress_family::pencils:
            return pencils(faces, random);
        case stress_family::soup:
            return soup(faces, random);
        case stress_family::on_plane_by_ulp:
            return on_plane_by_ulp(faces, random);
        case stress_family::broken_surfaces:
            return broken_surfaces(faces, random);
    }
    return {};
}

}  // namespace treeform::test
