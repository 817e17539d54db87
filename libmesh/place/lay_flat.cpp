#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/place/contacts.hpp>
#include <libmesh/place/quickhull.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::minus;

constexpr double equally_good = 0x1p-40;

void check(mesh_view mesh, const lay_flat_options& options) {
    detail::base::check_faces("lay_flat", mesh.points.size(), mesh.faces);
    detail::place::check_finite("lay_flat", mesh.points);
    if (!(options.tolerance >= 0.0) || std::isinf(options.tolerance))
        throw std::invalid_argument("treeform::lay_flat: the tolerance is negative or not finite");
    if (!std::isfinite(options.bed) ||
        !detail::base::is_finite(options.normal.value_or(options.point.value_or(point3{}))))
        throw std::invalid_argument(
            "treeform::lay_flat: the bed, direction or point is not finite");
    if (!(options.overhang_angle >= 0.0 && options.overhang_angle <= 90.0))
        throw std::invalid_argument(
            "treeform::lay_flat: the overhang angle is not between 0 and 90");
    if (options.normal == point3{})
        throw std::invalid_argument("treeform::lay_flat: the direction is zero");
    if (options.normal.has_value() + options.point.has_value() + options.most_stable > 1)
        throw std::invalid_argument(
            "treeform::lay_flat: normal, point and most_stable exclude each other");
}

/// Numbers of the points that faces use, ascending; of all when there are no faces.
std::vector<std::uint32_t> points_that_count(mesh_view mesh) {
    return mesh.faces.empty() ? detail::base::numbers_below(mesh.points.size())
                              : detail::base::used_points(mesh.points.size(), mesh.faces);
}

/// A hull with its sides by descending area; with a tolerance, sides are joined.
struct candidates {
    std::vector<point3> points;
    convex_hull_result hull;
};

/// For each face of a hull the sides across its edges.
std::vector<std::array<std::uint32_t, 3>> sides_around(const convex_hull_result& hull) {
    struct edge {
        std::uint32_t from, to, side;
        bool operator<(const edge& o) const {
            return std::pair(from, to) < std::pair(o.from, o.to);
        }
    };
    std::vector<edge> edges;
    for (std::uint32_t s = 0; s < hull.sides.size(); ++s)
        for (const face& f : hull.faces_of(hull.sides[s]))
            for (std::size_t k = 0; k < 3; ++k) edges.push_back({f[k], f[(k + 1) % 3], s});
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<std::uint32_t, 3>> around(hull.faces.size());
    for (std::size_t f = 0; f < around.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const edge back{hull.faces[f][(k + 1) % 3], hull.faces[f][k], 0};
            around[f][k] = std::lower_bound(edges.begin(), edges.end(), back)->side;
        }
    return around;
}

/// A side of which the sides `together` are part, with normal and center of their areas.
hull_side sum_of(const std::vector<hull_side>& sides, const std::vector<std::uint32_t>& together) {
    hull_side sum = sides[together[0]];
    if (together.size() == 1) return sum;
    const point3 origin = sum.center;
    double area = 0.0;
    point3 normal, center;
    for (const std::uint32_t i : together) {
        // Equal ones may be infinite, or zero.
        const double share = sides[i].area == sum.area ? 1.0 : sides[i].area / sum.area;
        area += share;
        for (std::size_t k = 0; k < 3; ++k) {
            normal[k] += share * sides[i].normal[k];
            center[k] += share * (0.5 * sides[i].center[k] - 0.5 * origin[k]);
        }
    }
    const double length = std::sqrt(dot(normal, normal));
    for (std::size_t k = 0; k < 3; ++k) {
        sum.normal[k] = normal[k] / length;
        sum.center[k] = origin[k] + 2.0 * (center[k] / area);
    }
    sum.area *= area;
    return sum;
}

/// Joins to each side, the largest first, what is around it within the tolerance of its plane and
/// not yet taken.
void join_sides(candidates& c, double tolerance) {
    const std::vector<std::array<std::uint32_t, 3>> around = sides_around(c.hull);
    const std::vector<hull_side>& sides = c.hull.sides;
    std::vector<bool> taken(sides.size());
    convex_hull_result joined;
    joined.dimension = c.hull.dimension;
    for (std::uint32_t first = 0; first < sides.size(); ++first) {
        if (taken[first]) continue;
        taken[first] = true;
        const hull_side& seed = sides[first];
        const auto in_plane = [&](const face& f) {
            return std::all_of(f.begin(), f.end(), [&](std::uint32_t i) {
                return std::abs(dot(seed.normal, minus(c.points[i], seed.center))) <= tolerance;
            });
        };
        std::vector<std::uint32_t> together{first};
        const auto faces_before = static_cast<std::uint32_t>(joined.faces.size());
        for (std::size_t i = 0; i < together.size(); ++i) {
            const hull_side& side = sides[together[i]];
            for (std::uint32_t f = 0; f < side.face_count; ++f) {
                joined.faces.push_back(c.hull.faces[side.first_face + f]);
                for (const std::uint32_t other : around[side.first_face + f]) {
                    const auto faces = c.hull.faces_of(sides[other]);
                    // Facing away: the other side of something thinner than the tolerance.
                    if (taken[other] || dot(seed.normal, sides[other].normal) <= 0.0 ||
                        !std::all_of(faces.begin(), faces.end(), in_plane))
                        continue;
                    taken[other] = true;
                    together.push_back(other);
                }
            }
        }
        hull_side& sum = joined.sides.emplace_back(sum_of(sides, together));
        sum.first_face = faces_before;
        sum.face_count = static_cast<std::uint32_t>(joined.faces.size()) - faces_before;
    }
    c.hull = std::move(joined);
}

void largest_first(std::vector<hull_side>& sides) {
    std::stable_sort(sides.begin(), sides.end(),
                     [](const hull_side& x, const hull_side& y) { return x.area > y.area; });
}

candidates sides_of(mesh_view mesh, const std::vector<std::uint32_t>& ids, double tolerance,
                    const progress_callback& progress) {
    candidates c;
    for (const std::uint32_t i : ids) c.points.push_back(mesh.points[i]);
    c.hull = convex_hull(c.points, progress);
    largest_first(c.hull.sides);
    if (tolerance > 0.0) {
        join_sides(c, tolerance);
        largest_first(c.hull.sides);
    }
    return c;
}

double angle_between(const point3& a, point3 b) {
    const double most = detail::base::largest_of(b);
    b = {b.x / most, b.y / most, b.z / most};
    const point3 c = cross(a, b);
    return std::atan2(std::sqrt(dot(c, c)), dot(a, b));
}

/// How far the sides are from a point, in lengths of the larger of the two.
std::vector<double> distances_to(const point3& p, const candidates& c) {
    double largest = detail::base::largest_of(p);
    for (const point3& q : c.points) largest = std::max(largest, detail::base::largest_of(q));
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double by = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    const auto scaled = [by](const point3& q) { return point3{q.x * by, q.y * by, q.z * by}; };
    std::vector<double> distances;
    for (const hull_side& side : c.hull.sides) {
        double least = std::numeric_limits<double>::infinity();
        for (const face& f : c.hull.faces_of(side)) {
            const triangle3 t{scaled(c.points[f[0]]), scaled(c.points[f[1]]),
                              scaled(c.points[f[2]])};
            least = std::min(least, closest_point(t, scaled(p)).squared_distance);
        }
        distances.push_back(std::sqrt(least));
    }
    return distances;
}

bool is_down(const candidates& c, const hull_side& side) {
    const std::span<const face> faces = c.hull.faces_of(side);
    const double z = c.points[faces[0][0]].z;
    return side.normal.z < 0.0 && std::all_of(faces.begin(), faces.end(), [&](const face& f) {
               return std::all_of(f.begin(), f.end(),
                                  [&](std::uint32_t i) { return c.points[i].z == z; });
           });
}

std::size_t choose(const candidates& c, std::span<const double> tip_angles,
                   const lay_flat_options& options) {
    const std::vector<hull_side>& sides = c.hull.sides;
    std::vector<double> cost;
    double slack = equally_good;
    if (options.normal) {
        for (const hull_side& side : sides)
            cost.push_back(angle_between(side.normal, *options.normal));
    } else if (options.point) {
        cost = distances_to(*options.point, c);
    } else if (options.most_stable) {
        for (const double angle : tip_angles) cost.push_back(1.0 - angle / 90.0);
    } else {
        for (const hull_side& side : sides)
            cost.push_back(side.area == sides[0].area ? 0.0 : 1.0 - side.area / sides[0].area);
    }
    slack += *std::min_element(cost.begin(), cost.end());
    std::size_t first = sides.size();
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (cost[i] > slack) continue;
        if (is_down(c, sides[i])) return i;
        first = std::min(first, i);
    }
    return first;
}

using matrix3 = std::array<point3, 3>;  // rows

point3 turned(const matrix3& m, const point3& p) {
    return {dot(m[0], p), dot(m[1], p), dot(m[2], p)};
}

/// The least rotation that turns the direction `n` to (0, 0, -1).
matrix3 shortest_turn_down(const point3& n) {
    const double sine = std::hypot(n.x, n.y);
    const double cosine = -n.z;
    // About the axis (x, y, 0), square to both; about the x axis when n points straight up.
    const double x = sine > 0.0 ? -n.y / sine : 1.0;
    const double y = sine > 0.0 ? n.x / sine : 0.0;
    const double rest = 1.0 - cosine;
    return {point3{cosine + rest * x * x, rest * x * y, sine * y},
            point3{rest * x * y, cosine + rest * y * y, -sine * x},
            point3{-sine * y, sine * x, cosine}};
}

/// Cosine and sine of the least turn about z after which the longest of the edges, of equal ones
/// the one that needs least, runs along x or y.
std::pair<double, double> turn_to_axes(const std::vector<point3>& edges) {
    double longest = 0.0;
    for (const point3& e : edges) longest = std::max(longest, std::hypot(e.x, e.y));
    std::pair<double, double> best{1.0, 0.0};
    double least = 2.0;
    for (const point3& e : edges) {
        const double length = std::hypot(e.x, e.y);
        if (!(length > 0.0) || std::isinf(length) || length < longest * (1.0 - equally_good))
            continue;
        double c = e.x / length, s = e.y / length;
        while (!(c > 0.0 && std::abs(s) <= c)) c = std::exchange(s, -c);
        if (std::abs(s) >= least) continue;
        least = std::abs(s);
        best = {c, -s};
    }
    return best;
}

matrix3 turn_down(const candidates& c, const hull_side& side, bool keep_spin) {
    matrix3 m = shortest_turn_down(side.normal);
    if (keep_spin) return m;
    std::vector<point3> edges;
    const std::vector<std::uint32_t> corners = c.hull.corners_of(side, c.points);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const point3 &from = c.points[corners[i]],
                     &to = c.points[corners[(i + 1) % corners.size()]];
        // Halved, so that no difference overflows.
        edges.push_back(turned(
            m, {0.5 * to.x - 0.5 * from.x, 0.5 * to.y - 0.5 * from.y, 0.5 * to.z - 0.5 * from.z}));
    }
    const auto [cosine, sine] = turn_to_axes(edges);
    const auto [a, b, down] = m;
    m[0] = {cosine * a.x - sine * b.x, cosine * a.y - sine * b.y, cosine * a.z - sine * b.z};
    m[1] = {sine * a.x + cosine * b.x, sine * a.y + cosine * b.y, sine * a.z + cosine * b.z};
    return m;
}

/// Where the points go: turned about `base`, which comes to the bed, and back to where the center
/// of their box was.
struct motion {
    matrix3 turn;
    point3 base;
    point3 target;
    bool turns;

    [[nodiscard]] point3 operator()(const point3& p) const {
        const point3 from = minus(p, base);
        if (!turns) return {p.x, p.y, from.z + target.z};
        const point3 q = turned(turn, from);
        return {q.x + target.x, q.y + target.y, q.z + target.z};
    }
    [[nodiscard]] transform<3> matrix() const {
        transform<3> result;
        const point3 at = turned(turn, base);
        for (std::size_t k = 0; k < 3; ++k)
            result.rows[k] = {turn[k].x, turn[k].y, turn[k].z, target[k] - at[k]};
        return result;
    }
};

motion find_motion(const candidates& c, const hull_side& side, const lay_flat_options& options,
                   double bed) {
    motion m{
        turn_down(c, side, options.keep_spin), c.points[c.hull.faces_of(side)[0][0]], {}, true};
    m.turns = m.turn != matrix3{point3{1, 0, 0}, point3{0, 1, 0}, point3{0, 0, 1}};
    m.target = {m.base.x, m.base.y, bed};
    if (!m.turns) return m;
    std::vector<point3> there;
    there.reserve(c.points.size());
    for (const point3& p : c.points) there.push_back(turned(m.turn, minus(p, m.base)));
    const auto before = bounding_box(c.points);
    const auto after = bounding_box(there);
    if (!after) return m;  // all overflow, which is found when the points are
    for (std::size_t k = 0; k < 2; ++k)
        m.target[k] = 0.5 * before->min[k] + 0.5 * before->max[k] -
                      (0.5 * after->min[k] + 0.5 * after->max[k]);
    return m;
}

/// The points in their places, those of the side on the bed and none that counts below it.
void put_down(laid_flat& laid, mesh_view mesh, const std::vector<std::uint32_t>& ids,
              const plane_points& plane, const motion& move, const lay_flat_options& options) {
    laid.points.reserve(mesh.points.size());
    for (const point3& p : mesh.points) {
        point3 q = move(p);
        if (options.precision == precision::float32)
            for (std::size_t k = 0; k < 3; ++k) q[k] = detail::base::nearest_float(q[k]);
        if (!detail::base::is_finite(q))
            throw std::overflow_error(
                "treeform::lay_flat: the coordinates are too large to be turned");
        laid.points.push_back(q);
    }
    for (const std::uint32_t i : ids) {
        double& z = laid.points[i].z;
        const bool on_bed = (options.tolerance > 0.0 && z - laid.bed <= options.tolerance) ||
                            orient3d(plane.a, plane.b, plane.c, mesh.points[i]) == 0;
        if (on_bed) laid.on_bed.push_back(i);
        const double right = on_bed ? laid.bed : std::max(z, laid.bed);
        laid.corrected = std::max(laid.corrected, std::abs(right - z));
        z = right;
    }
}

/// How it stands on each side; and the one that is chosen.
void look_at_stability(laid_flat& laid, mesh_view mesh, const std::vector<std::uint32_t>& ids,
                       const candidates& found, const lay_flat_options& options) {
    const auto center = detail::place::center_of_mass(mesh, ids);
    laid.center_of_mass = center.at;
    laid.mass_dimension = center.dimension;
    laid.center_heights = detail::place::heights_over_sides(found.hull, center.at);
    laid.tip_angles =
        detail::place::tip_angles(found.points, found.hull, center.at, laid.center_heights);
    laid.overhangs.assign(laid.sides.size(), std::numeric_limits<double>::quiet_NaN());
    laid.chosen = choose(found, laid.tip_angles, options);
    double size = 0.0;
    for (const point3& p : found.points) size = std::max(size, detail::base::largest_of(p));
    const double flat = std::max(options.tolerance, size * 0x1p-40);
    detail::base::for_numbers(laid.sides.size(), 1, [&](std::size_t i) {
        if (i < options.overhang_sides || i == laid.chosen)
            laid.overhangs[i] =
                detail::place::overhang_of(mesh, laid.sides[i], options.overhang_angle, flat);
    });
}

}  // namespace

std::optional<laid_flat> lay_flat(const mesh_ref& given, const lay_flat_options& options) {
    const detail::base::prepared_ref held(given);  // a cloud has faces to touch the bed with
    const mesh_view mesh = held.view();
    check(mesh, options);
    const std::vector<std::uint32_t> ids = points_that_count(mesh);
    detail::base::work_progress work(options.progress);
    const candidates found = sides_of(mesh, ids, options.tolerance, work.part(0.0, 0.8));
    if (work.cancelled()) return laid_flat{.certificate = {.status = status::cancelled}};
    if (found.hull.sides.empty()) return std::nullopt;

    laid_flat laid;
    laid.sides = found.hull.sides;
    look_at_stability(laid, mesh, ids, found, options);
    laid.bed = detail::place::not_below(options.bed, options.precision);
    const hull_side& side = laid.sides[laid.chosen];
    const motion move = find_motion(found, side, options, laid.bed);
    laid.matrix = move.matrix();
    if (!laid.matrix.finite())
        throw std::overflow_error("treeform::lay_flat: the coordinates are too large for a matrix");
    const face& f = found.hull.faces_of(side)[0];
    const plane_points plane{found.points[f[0]], found.points[f[1]], found.points[f[2]]};
    put_down(laid, mesh, ids, plane, move, options);
    laid.contact = detail::place::contact_with_bed({laid.points, mesh.faces});
    laid.certificate.precision = options.precision;
    laid.certificate.max_displacement =
        detail::max_displacement(mesh.points, laid.matrix, laid.points);
    work.reach(1.0);
    return laid;
}

}  // namespace treeform
