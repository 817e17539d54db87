#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/turn_motion.hpp>
#include <treeform/tree/nearness_pair.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace treeform::detail::place {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::plus;
using base::scaled;
using base::triangle_of;

constexpr double widest_step = 0.25;  // radians
constexpr std::size_t fewest_pairs = 64, most_pairs = 16'384;

/// What the rounding of moved corners and of distances may come to: some 20 units in the last place
/// of the largest coordinate, or distance from the axis, taken together.
double slack_of(const shape& moving, std::span<const shape> parts, const unit_axis& axis) {
    double largest = base::largest_of(axis.origin);
    const auto include = [&](mesh_view mesh) {
        if (const auto box = box_of_faces(mesh))
            largest = std::max({largest, base::largest_of(box->min), base::largest_of(box->max)});
    };
    include(moving.mesh());
    for (const shape& part : parts) include(part.mesh());
    return largest * 0x1p-46;
}

/// Two faces near each other, `a` of the mesh that turns.
struct near_pair {
    std::uint32_t a, b;
    closest_between_triangles at;
    std::size_t part;
};

/// The faces near each other at some angle.
struct near_state {
    std::vector<near_pair> pairs{};
    double all_within = 0.0;  ///< all pairs of faces nearer than this are there
    bool full = false;        ///< as many as were asked for: there may be more
};

/// Two parallel planes between two triangles.
struct gap_across {
    point3 u;  ///< of length 1, from a to b; 0 when there are no such planes
    double width = -std::numeric_limits<double>::infinity();
    double beyond = 0.0;  ///< u . x of the plane at b
};

void take_wider(gap_across& best, point3 u, const triangle3& a, const triangle3& b) {
    const double size = length_of(u);
    if (!(size > 0.0) || !std::isfinite(size)) return;
    u = scaled(u, 1.0 / size);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const point3& p : a) high = std::max(high, dot(u, p));
    for (const point3& p : b) low = std::min(low, dot(u, p));
    if (low - high > best.width) best = {u, low - high, low};
}

/// Across the line between the nearest points; where these are so near that it has no exact
/// direction, across a face or a pair of edges.
gap_across widest_gap(const triangle3& a, const triangle3& b, const closest_between_triangles& at) {
    gap_across best;
    take_wider(best, minus(at.on_b, at.on_a), a, b);
    if (best.width > 0.9 * std::sqrt(at.squared_distance)) return best;
    const auto both_ways = [&](const point3& u) {
        take_wider(best, u, a, b);
        take_wider(best, scaled(u, -1.0), a, b);
    };
    const auto edge = [](const triangle3& t, std::size_t k) { return minus(t[(k + 1) % 3], t[k]); };
    both_ways(cross(edge(a, 0), edge(a, 1)));
    both_ways(cross(edge(b, 0), edge(b, 1)));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) both_ways(cross(edge(a, i), edge(b, j)));
    return best;
}

class turn_searching {
  public:
    turn_searching(const shape& moving, std::span<const shape> parts, const unit_axis& axis,
                   const turn_search_options& options)
        : moving_(moving),
          parts_(parts),
          axis_(axis),
          options_(options),
          slack_(slack_of(moving, parts, axis)),
          work_(options_.progress) {}

    [[nodiscard]] turn_search run() {
        using enum turn_search::end_of;
        turn_search found;
        double trial = widest_step;
        std::size_t most = fewest_pairs;
        while (true) {
            if (!work_.reach(found.angle / options_.latest)) return {.outcome = cancelled};
            if (found.steps++ == options_.max_steps) {
                found.outcome = gave_up;
                return found;
            }
            const double reach = options_.clearance + options_.radius * trial + slack_;
            const transform<3> there = axis_.by(found.angle);
            const near_state state = look(there, reach, most);
            found.pairs += state.pairs.size();
            double nearest = std::numeric_limits<double>::infinity();
            double step = state.full
                              ? std::max(0.0, state.all_within - options_.clearance - slack_) /
                                    options_.radius
                              : trial;
            const bool by_number = state.full;
            for (const near_pair& pair : state.pairs) {
                nearest = std::min(nearest, std::sqrt(pair.at.squared_distance));
                step = std::min(step, free_angle(there, pair));
            }
            if (nearest <= options_.clearance + std::max(options_.tolerance, 2.0 * slack_)) {
                found.outcome = met;
                found.contacts = contacts_at(state, nearest);
                return found;
            }
            if (!(found.angle + step > found.angle)) {
                found.outcome = gave_up;
                return found;
            }
            found.angle += step;
            if (found.angle >= options_.latest) {
                found.angle = options_.latest;
                return found;
            }
            // More pairs where their number was what kept the step short.
            if (by_number)
                most = std::min(most_pairs, 2 * most);
            else
                most = std::max(fewest_pairs, most / 2);
            trial = std::min(widest_step, std::max(2.0 * step, 0.25 * trial));
        }
    }

  private:
    [[nodiscard]] triangle3 face_at(const transform<3>& there, std::uint32_t f) const {
        triangle3 t = triangle_of(moving_.mesh(), f);
        for (point3& p : t) p = there(p);
        return t;
    }

    [[nodiscard]] near_state look(const transform<3>& there, double reach, std::size_t most) const {
        near_state state{.all_within = reach};
        const transformed<3> moved(moving_.faces(), there);
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            const mesh_view fixed = parts_[part].mesh();
            const auto pairs = k_nearest_pairs(
                moved, parts_[part].faces(), most,
                [&](std::uint32_t a, std::uint32_t b) {
                    return closest_pair(face_at(there, a), triangle_of(fixed, b));
                },
                reach);
            for (const auto& [faces, at] : pairs)
                state.pairs.push_back({faces.first, faces.second, at, part});
            if (pairs.size() < most) continue;
            state.full = true;
            state.all_within =
                std::min(state.all_within, std::sqrt(pairs.back().answer.squared_distance));
        }
        return state;
    }

    /// An angle within which two faces come no nearer than the clearance.
    ///
    /// Planes across u keep them apart: all of a lies before u . x = A, all of b beyond B. Turned
    /// by f, a corner p of a moves by sin f (u . v) - (1 - cos f) (u . w) along u, with v its
    /// velocity and w its offset from the axis: for f in [0, pi] by no more than f max(0, u . v) +
    /// f^2 / 2 max(0, -u . w). That holds for any u of length 1; which one is taken only decides
    /// how far the step leads.
    [[nodiscard]] double free_angle(const transform<3>& there, const near_pair& pair) const {
        const triangle3 a = face_at(there, pair.a);
        const triangle3 b = triangle_of(parts_[pair.part].mesh(), pair.b);
        const gap_across across = widest_gap(a, b, pair.at);
        if (!(across.width - options_.clearance - slack_ > 0.0)) return 0.0;
        double least = widest_step;
        for (const point3& p : a) {
            const double free = across.beyond - dot(across.u, p) - options_.clearance - slack_;
            const double linear = std::max(0.0, dot(across.u, axis_.velocity(p)));
            const double square = std::max(0.0, -dot(across.u, axis_.across(p)));
            const double root = linear + std::sqrt(linear * linear + 2.0 * square * free);
            if (root > 0.0) least = std::min(least, 2.0 * free / root);
        }
        return least * (1.0 - 0x1p-40);
    }

    [[nodiscard]] std::vector<placement_contact> contacts_at(const near_state& state,
                                                             double nearest) const {
        std::vector<near_pair> near;
        const double within = nearest + std::max(options_.tolerance, 2.0 * slack_);
        for (const near_pair& pair : state.pairs)
            if (std::sqrt(pair.at.squared_distance) <= within) near.push_back(pair);
        std::sort(near.begin(), near.end(), [](const near_pair& x, const near_pair& y) {
            return std::tuple(x.part, x.a, x.b) < std::tuple(y.part, y.a, y.b);
        });
        near.resize(std::min(near.size(), options_.limit));
        std::vector<placement_contact> contacts;
        for (const near_pair& pair : near) {
            const point3 way = minus(pair.at.on_a, pair.at.on_b);
            const double size = length_of(way);
            const point3 normal = size > 0.0 ? scaled(way, 1.0 / size) : point3{};
            contacts.push_back({pair.at.on_b, normal, pair.a, pair.b, pair.part});
        }
        return contacts;
    }

    const shape& moving_;
    std::span<const shape> parts_;
    const unit_axis& axis_;
    const turn_search_options& options_;
    double slack_;
    base::work_progress work_;
};

}  // namespace

unit_axis::unit_axis(const point3& through, const point3& along)
    : origin(through), direction(along) {
    const double largest = base::largest_of(direction);
    for (std::size_t k = 0; k < 3; ++k) direction[k] /= largest;
    direction = scaled(direction, 1.0 / length_of(direction));
}

point3 unit_axis::across(const point3& p) const {
    const point3 from = minus(p, origin);
    return minus(from, scaled(direction, dot(from, direction)));
}

point3 unit_axis::velocity(const point3& p) const { return cross(direction, minus(p, origin)); }

transform<3> unit_axis::by(double radians) const {
    const double c = std::cos(radians), s = std::sin(radians);
    const point3& n = direction;
    transform<3> m;
    const std::array<point3, 3> turn_of{point3{0.0, -n.z, n.y}, {n.z, 0.0, -n.x}, {-n.y, n.x, 0.0}};
    for (std::size_t i = 0; i < 3; ++i) {
        double moved = 0.0;
        for (std::size_t j = 0; j < 3; ++j) {
            m.rows[i][j] = (i == j ? c : 0.0) + (1.0 - c) * n[i] * n[j] + s * turn_of[i][j];
            moved += m.rows[i][j] * origin[j];
        }
        m.rows[i][3] = radians == 0.0 ? 0.0 : origin[i] - moved;
    }
    return m;
}

swept_ring ring_of(mesh_view mesh, const unit_axis& axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    swept_ring ring;
    for (const face& f : mesh.faces)
        for (const std::uint32_t i : f) {
            const double along = dot(minus(mesh.points[i], axis.origin), axis.direction);
            low = std::min(low, along);
            high = std::max(high, along);
            ring.radius = std::max(ring.radius, length_of(axis.across(mesh.points[i])));
        }
    const point3 a = plus(axis.origin, scaled(axis.direction, low));
    const point3 b = plus(axis.origin, scaled(axis.direction, high));
    for (std::size_t k = 0; k < 3; ++k) {
        const double n = axis.direction[k];
        const double wide = ring.radius * std::sqrt(std::max(0.0, 1.0 - n * n));
        ring.box.min[k] = std::min(a[k], b[k]) - wide;
        ring.box.max[k] = std::max(a[k], b[k]) + wide;
    }
    return ring;
}

turn_search search_turn(const shape& moving, std::span<const shape> parts, const unit_axis& axis,
                        const turn_search_options& options) {
    return turn_searching(moving, parts, axis, options).run();
}

}  // namespace treeform::detail::place
