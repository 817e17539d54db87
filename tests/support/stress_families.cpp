#include "support/stress_families.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace tf::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

point3 operator+(const point3& p, const point3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
point3 operator-(const point3& p, const point3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
point3 operator*(double s, const point3& p) { return {s * p.x, s * p.y, s * p.z}; }
point3 cross(const point3& p, const point3& q) {
    return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

/// By repeated multiplication, since std::pow may differ in the last bit.
double power_of_ten(int exponent) {
    double result = 1.0;
    for (int i = 0; i < std::abs(exponent); ++i) result *= 10.0;
    return exponent < 0 ? 1.0 / result : result;
}

template <class Change>
triangle3 changed(const triangle3& t, Change change) {
    return {change(t[0]), change(t[1]), change(t[2])};
}

// --- points and triangles; numbers are drawn in an order that the language fixes ---

point3 random_point(random_source& random) { return {random.unit(), random.unit(), random.unit()}; }
triangle3 random_triangle(random_source& random) {
    return {random_point(random), random_point(random), random_point(random)};
}
point3 lattice_point(random_source& random, int low, int high) {
    return {random.whole(low, high), random.whole(low, high), random.whole(low, high)};
}
triangle3 lattice_triangle(random_source& random, int low, int high) {
    return {lattice_point(random, low, high), lattice_point(random, low, high),
            lattice_point(random, low, high)};
}
/// Coordinates of 10 bits, so that points with small dyadic weights are exact.
triangle3 dyadic_triangle(random_source& random) {
    return changed(lattice_triangle(random, 0, 1024), [](const point3& p) { return 0x1p-10 * p; });
}

/// A point of the plane of `t`: half the time with weights of whole eighths, which are exact for
/// dyadic corners and often lie on an edge or a corner, else with any weights.
point3 point_on_plane(const triangle3& t, random_source& random) {
    const bool eighths = random.one_in(2);
    const auto weight = [&] {
        return eighths ? random.whole(-2, 10) / 8 : 1.25 * random.unit() - 0.125;
    };
    const double u = weight();
    const double v = weight();
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

/// A corner, a point of an edge, or any point of the closed triangle.
point3 point_of(const triangle3& t, random_source& random) {
    const std::size_t i = random.below(3);
    const point3& p = t[i];
    const point3& q = t[(i + 1) % 3];
    const double u = random.whole(1, 7) / 8;
    switch (random.below(3)) {
        case 0:
            return p;
        case 1:
            return p + u * (q - p);
        default:
            return p + u * (q - p) + (1 - u) / 2 * (t[(i + 2) % 3] - p);
    }
}

point3 moved_by_ulps(point3 p, int ulps, random_source& random) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double towards = random.one_in(2) ? infinity : -infinity;
        const auto steps = random.below(static_cast<std::uint64_t>(ulps) + 1);
        for (std::uint64_t i = 0; i < steps; ++i) p[axis] = std::nextafter(p[axis], towards);
    }
    return p;
}

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
    constexpr std::array<double, 7> units{0x1p-1074, 0x1p-1023, 1e-310, 1e-150, 1.0, 1e150, 1e300};
    const double common = units[random.below(units.size())];
    const bool mixed = random.one_in(2);
    const auto coordinate = [&] {
        const double unit = mixed && random.one_in(4) ? units[random.below(units.size())] : common;
        return random.whole(-3, 3) * unit;  // gives zeros of either sign
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
    }
    return {};
}

// --- placement ---

using matrix = std::array<point3, 3>;  // rows

/// From a random quaternion; orthogonal up to rounding.
matrix random_rotation(random_source& random) {
    const double w = random.unit() + 0x1p-10;
    const double x = random.unit() - 0.5;
    const double y = random.unit() - 0.5;
    const double z = random.unit() - 0.5;
    const double s = 2 / (w * w + x * x + y * y + z * z);
    return {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
             {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
             {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

matrix random_exchange_of_axes(random_source& random) {
    matrix rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::swap(rows[0], rows[random.below(3)]);
    std::swap(rows[1], rows[1 + random.below(2)]);
    return rows;
}

point3 times(const matrix& m, const point3& p) {
    const auto row = [&](const point3& r) { return r.x * p.x + r.y * p.y + r.z * p.z; };
    return {row(m[0]), row(m[1]), row(m[2])};
}

double as_float(double x) {
    return std::abs(x) > std::numeric_limits<float>::max() ? x : static_cast<float>(x);
}

triangle_pair placed(const triangle_pair& pair, random_source& random) {
    constexpr std::array<double, 5> distances{0, 1, 1e3, 1e6, 1e9};
    const bool exact = random.one_in(2);
    const bool single = random.one_in(2);
    const matrix turn = exact ? random_exchange_of_axes(random) : random_rotation(random);
    const double scale = exact ? std::ldexp(1.0, static_cast<int>(random.below(201)) - 100)
                               : power_of_ten(static_cast<int>(random.below(61)) - 30);
    const double distance = distances[random.below(distances.size())];
    const point3 away = distance * lattice_point(random, -1, 1);
    const auto place = [&](const point3& p) {
        const point3 q = scale * (times(turn, p) + away);
        return single ? point3{as_float(q.x), as_float(q.y), as_float(q.z)} : q;
    };
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
        "near_coplanar", "slivers",       "coplanar_grid", "cad_grid",       "large_offsets",
        "mixed_scales",  "extreme_range", "fans",          "duplicates",     "one_ulp",
        "thin_shells",   "pencils",       "soup",          "on_plane_by_ulp"};
    return names[static_cast<std::size_t>(family)];
}

triangle_pair stress_stream::next() {
    triangle_pair pair = shape_of(family_, random_);
    if (family_ != stress_family::extreme_range) pair = placed(pair, random_);
    pair = {reordered(pair.a, random_), reordered(pair.b, random_)};
    if (random_.one_in(2)) std::swap(pair.a, pair.b);
    return pair;
}

}  // namespace tf::test
