#include "support/stress_families.hpp"

#include "support/stress_parts.hpp"
#include "support/stress_placement.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace treeform::test {
namespace {

using namespace stress;

// --- families, about unit size at the origin ---

triangle_pair near_coplanar(random_source& random) {
    const triangle3 a = dyadic_triangle(random);
    const point3 normal = cross(a[1] - a[0], a[2] - a[0]);
    const double height = power_of_ten(-static_cast<int>(1 + random.below(16)));
    const auto corner = [&] {
        const point3 foot = point_on_plane(a, random);
        return foot + random.whole(-1, 1) * height * normal;
    };
    return {a, {corner(), corner(), corner()}};
}

/// A needle along a line through `p`, which is one of its corners at times.
triangle3 sliver_through(const point3& p, random_source& random) {
    const point3 direction = 0x1p-3 * lattice_point(random, -8, 8);
    const auto off = [&] {
        const double size = power_of_ten(-static_cast<int>(random.below(13)));
        return size * lattice_point(random, -1, 1);
    };
    const double back = random.whole(0, 4) / 4;
    const double between = random.whole(-4, 4) / 4;
    return {p - back * direction, p + direction, p + between * direction + off()};
}

triangle_pair slivers(random_source& random) {
    const point3 origin = 0x1p-3 * lattice_point(random, 0, 8);
    const triangle3 a = random.one_in(2) ? sliver_through(origin, random) : dyadic_triangle(random);
    return {a, sliver_through(point_of(a, random), random)};
}

/// Half of a face of an axis-parallel cube with whole corners.
triangle3 half_of_cube_face(random_source& random) {
    const point3 low = lattice_point(random, 0, 2);
    const double size = random.one_in(3) ? 3 : random.whole(1, 2);
    const std::size_t axis = random.below(3);
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<point3, 4> square{low, low, low, low};
    const double level = low[axis] + (random.one_in(2) ? size : 0);
    for (point3& p : square) p[axis] = level;
    square[1][u] += size;
    square[2][u] += size;
    square[2][v] += size;
    square[3][v] += size;
    const std::size_t first = random.below(4);
    return {square[first], square[(first + 1) % 4], square[(first + 2) % 4]};
}

triangle_pair coplanar_grid(random_source& random) {
    if (random.one_in(3)) return {half_of_cube_face(random), half_of_cube_face(random)};
    const bool oblique = random.one_in(2);
    const auto onto_plane = [&](const point3& p) {
        return point3{p.x, p.y, oblique ? p.x + 2 * p.y : 1.0};
    };
    return {changed(lattice_triangle(random, 0, 4), onto_plane),
            changed(lattice_triangle(random, 0, 4), onto_plane)};
}

triangle_pair cad_grid(random_source& random) {
    constexpr std::array<double, 3> steps{0.125, 0.1, 1e-3};
    const double step = steps[random.below(3)];
    const auto snapped = [&](const point3& p) { return step * p; };
    return {changed(lattice_triangle(random, 0, 3), snapped),
            changed(lattice_triangle(random, 0, 3), snapped)};
}

triangle_pair soup(random_source& random) {
    return {random_triangle(random), random_triangle(random)};
}

triangle_pair large_offsets(random_source& random) {
    triangle_pair pair = random.one_in(2) ? soup(random) : cad_grid(random);
    if (random.one_in(2)) pair.b[random.below(3)] = point_of(pair.a, random);
    const auto offset = [&] {
        const double size = power_of_ten(3 * static_cast<int>(1 + random.below(5)));
        return size * random.whole(-1, 1);
    };
    const point3 away{offset(), offset(), offset()};
    const auto move = [&](const point3& p) { return p + away; };
    return {changed(pair.a, move), changed(pair.b, move)};
}

triangle_pair mixed_scales(random_source& random) {
    const bool dyadic = random.one_in(2);
    const double large = dyadic ? 0x1p20 : 1e6;
    const double small = dyadic ? 0x1p-20 : 1e-6;
    const triangle3 a =
        changed(lattice_triangle(random, 0, 8), [&](const point3& p) { return large * p; });
    const point3 at = point_of(a, random);
    const triangle3 b =
        changed(lattice_triangle(random, -2, 2), [&](const point3& p) { return at + small * p; });
    return {a, b};
}

triangle_pair extreme_range(random_source& random) {
    constexpr std::size_t units = std::size(extreme_units);
    const double common = extreme_units[random.below(units)];
    const bool mixed = random.one_in(2);
    const auto coordinate = [&] {
        const bool other = mixed && random.one_in(4);
        return extreme_coordinate(other ? extreme_units[random.below(units)] : common, random);
    };
    const auto corner = [&] { return point3{coordinate(), coordinate(), coordinate()}; };
    triangle_pair pair{{corner(), corner(), corner()}, {corner(), corner(), corner()}};
    for (std::size_t i = 0; i < 3; ++i)
        if (random.one_in(4)) pair.b[i] = pair.a[random.below(3)];
    return pair;
}

triangle_pair fans(random_source& random) {
    const std::uint64_t valence = random.one_in(2) ? 100'000 : 8;
    const double height = random.whole(0, 2) / 4;
    const bool bumpy = random.one_in(3);
    const auto rim = [&](std::uint64_t i) {
        const double t = static_cast<double>(i % valence) / static_cast<double>(valence);
        const double w = 1 + t * t;
        return point3{(1 - t * t) / w, 2 * t / w, bumpy ? 1e-9 * random.whole(-1, 1) : 0.0};
    };
    const std::uint64_t i = random.below(valence);
    const std::uint64_t k = random.one_in(4) ? random.below(valence) : i + random.below(3);
    const point3 apex{0, 0, height};
    const std::array<point3, 2> shared{rim(i), rim(i + 1)};
    triangle_pair pair{{apex, shared[0], shared[1]}, {apex, rim(k), rim(k + 1)}};
    if (k <= i + 1) pair.b[1] = shared[k < i ? 0 : k - i];               // the very same rim point
    if (random.one_in(8)) pair.b[2] = point_of(pair.a, random);          // a fold
    if (random.one_in(4)) pair.b[0].z += 0x1p-40 * random.whole(-1, 1);  // an apex close by
    return pair;
}

triangle3 any_triangle(random_source& random) {
    switch (random.below(3)) {
        case 0:
            return random_triangle(random);
        case 1:
            return dyadic_triangle(random);
        default:
            return cad_grid(random).a;
    }
}

triangle_pair duplicates(random_source& random) {
    const triangle3 a = any_triangle(random);
    triangle3 b = a;
    point3& corner = b[random.below(3)];
    const point3 step = 0x1p-40 * lattice_point(random, -1, 1);
    switch (random.below(5)) {
        case 0:
            corner = moved_by_ulps(corner, 1, random);
            break;
        case 1:
            corner = point_on_plane(a, random);
            break;
        case 2:
            corner = random_point(random);
            break;
        case 3:
            b = changed(a, [&](const point3& p) { return p + step; });
            break;
        default:
            break;
    }
    return {a, b};
}

/// Two triangles of a sheet of 2 x 2 squares, the second rotated by next to nothing.
triangle_pair one_ulp(random_source& random) {
    const bool flat = random.one_in(2);
    std::array<point3, 9> sheet;
    for (std::size_t i = 0; i < 9; ++i)
        sheet[i] = {static_cast<double>(i % 3) / 3, static_cast<double>(i / 3) / 3,
                    flat ? 0.25 : random.unit()};
    const auto pick = [&]() -> triangle3 {
        const std::size_t low = std::array<std::size_t, 4>{0, 1, 3, 4}[random.below(4)];
        if (random.one_in(2)) return {sheet[low], sheet[low + 1], sheet[low + 4]};
        return {sheet[low], sheet[low + 4], sheet[low + 3]};
    };
    const double size = random.one_in(2) ? 0x1p-53 : 0x1p-51;
    const double angle = size * random.whole(-1, 1);
    const std::size_t axis = random.below(3);
    const auto rotated = [&](const point3& p) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        point3 q = p;
        q[u] = p[u] - angle * p[v];
        q[v] = p[v] + angle * p[u];
        return q;
    };
    return {pick(), changed(pick(), rotated)};
}

triangle_pair thin_shells(random_source& random) {
    const triangle3 a = any_triangle(random);
    triangle3 b = a;
    if (random.one_in(2))
        b = {point_on_plane(a, random), point_on_plane(a, random), point_on_plane(a, random)};
    if (random.one_in(2))
        return {a, changed(b, [&](const point3& p) { return moved_by_ulps(p, 10, random); })};
    const double size = 0x1p-52 * random.whole(1, 10);
    const point3 step = size * lattice_point(random, -1, 1);
    return {a, changed(b, [&](const point3& p) { return p + step; })};
}

triangle_pair pencils(random_source& random) {
    const point3 origin = 0x1p-3 * lattice_point(random, 0, 8);
    const point3 direction = 0x1p-3 * lattice_point(random, -8, 8);
    const auto on_line = [&] { return origin + random.whole(-4, 4) / 4 * direction; };
    const auto with_edge_on_line = [&] {
        return triangle3{on_line(), on_line(), 0x1p-3 * lattice_point(random, -8, 8)};
    };
    /// The middle of its first side is on the line.
    const auto across_line = [&] {
        const point3 v = 0x1p-3 * lattice_point(random, -4, 4);
        const point3 p = on_line();
        return triangle3{p + v, p - v, 0x1p-3 * lattice_point(random, -8, 8)};
    };
    return {with_edge_on_line(), random.one_in(2) ? with_edge_on_line() : across_line()};
}

triangle_pair on_plane_by_ulp(random_source& random) {
    const triangle3 a = random.one_in(2) ? dyadic_triangle(random) : random_triangle(random);
    const auto corner = [&] {
        const point3 p = random.one_in(2) ? point_of(a, random) : point_on_plane(a, random);
        return random.one_in(2) ? p : moved_by_ulps(p, 1, random);
    };
    triangle3 b{corner(), corner(), corner()};
    if (random.one_in(2)) b[2] = random_point(random);
    if (random.one_in(4)) b[1] = random_point(random);
    return {a, b};
}

/// Faces side by side as scans and careless programs leave them: the edge of one ends within that
/// of the other, corners are written with few digits, a face is folded back, or nothing fits.
triangle_pair broken_surfaces(random_source& random) {
    const triangle3 a = random.one_in(2) ? dyadic_triangle(random) : random_triangle(random);
    const point3 third = random_point(random);
    const double weight = random.one_in(2) ? random.whole(1, 7) / 8 : random.unit();
    const point3 on_edge = a[0] + weight * (a[1] - a[0]);
    switch (random.below(6)) {
        case 0:
            return {a, {on_edge, a[1], third}};
        case 1:
            return {a, {a[1], on_edge, third}};
        case 2:
            return {changed(a, with_three_digits), {a[1], a[0], third}};
        case 3:
            return {changed(a, with_three_digits), {on_edge, a[1], third}};
        case 4:
            return {a, {a[1], a[0], point_on_plane(a, random)}};
        default:
            return {a, changed(a, [&](const point3& p) { return p + 0x1p-2 * third; })};
    }
}

triangle_pair shape_of(stress_family family, random_source& random) {
    switch (family) {
        case stress_family::near_coplanar:
            return near_coplanar(random);
        case stress_family::slivers:
            return slivers(random);
        case stress_family::coplanar_grid:
            return coplanar_grid(random);
        case stress_family::cad_grid:
            return cad_grid(random);
        case stress_family::large_offsets:
            return large_offsets(random);
        case stress_family::mixed_scales:
            return mixed_scales(random);
        case stress_family::extreme_range:
            return extreme_range(random);
        case stress_family::fans:
            return fans(random);
        case stress_family::duplicates:
            return duplicates(random);
        case stress_family::one_ulp:
            return one_ulp(random);
        case stress_family::thin_shells:
            return thin_shells(random);
        case stress_family::pencils:
            return pencils(random);
        case stress_family::soup:
            return soup(random);
        case stress_family::on_plane_by_ulp:
            return on_plane_by_ulp(random);
        case stress_family::broken_surfaces:
            return broken_surfaces(random);
    }
    return {};
}

triangle_pair placed(const triangle_pair& pair, random_source& random) {
    const placement where = random_placement(random);
    const auto place = [&](const point3& p) { return placed(p, where); };
    return {changed(pair.a, place), changed(pair.b, place)};
}

triangle3 reordered(triangle3 t, random_source& random) {
    std::swap(t[0], t[random.below(3)]);
    std::swap(t[1], t[1 + random.below(2)]);
    return t;
}

}  // namespace

std::string_view name_of(stress_family family) {
    constexpr std::array<std::string_view, stress_family_count> names{
        "near_coplanar", "slivers",       "coplanar_grid", "cad_grid",        "large_offsets",
        "mixed_scales",  "extreme_range", "fans",          "duplicates",      "one_ulp",
        "thin_shells",   "pencils",       "soup",          "on_plane_by_ulp", "broken_surfaces"};
    return names[static_cast<std::size_t>(family)];
}

std::optional<stress_family> stress_family_named(std::string_view name) {
    for (std::size_t f = 0; f < stress_family_count; ++f)
        if (name_of(static_cast<stress_family>(f)) == name) return static_cast<stress_family>(f);
    return {};
}

triangle_pair stress_stream::next() {
    triangle_pair pair = shape_of(family_, random_);
    if (family_ != stress_family::extreme_range) pair = placed(pair, random_);
    pair = {reordered(pair.a, random_), reordered(pair.b, random_)};
    if (random_.one_in(2)) std::swap(pair.a, pair.b);
    return pair;
}

}  // namespace treeform::test
