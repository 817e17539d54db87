#include <libmesh/detail/check_faces.hpp>
#include <libmesh/detail/union_find.hpp>
#include <libmesh/weld/detail/reach.hpp>
#include <libmesh/weld/weld_points.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace tf {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

bool finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Cubes of edge `edge_` >= 2 * distance about a corner of the box. Two points within `distance`
/// then lie in cubes that are equal or adjacent, and on each axis only towards the nearer side.
class cells {
  public:
    cells(points_view points, double distance) {
        const double big = std::numeric_limits<double>::infinity();
        std::array<double, 3> low{big, big, big};
        std::array<double, 3> high{-big, -big, -big};
        for (const point3& p : points) {
            if (!finite(p)) continue;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], p[axis] * 0.25);
                high[axis] = std::max(high[axis], p[axis] * 0.25);
            }
        }
        double extent = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            extent = std::max(extent, high[axis] - low[axis]);
        // Quarters keep the extent of any finite box finite. At most 2^20 cubes a side: an index
        // fits 21 bits. The quotient below is at most 2^20 and off by less than 2^-31, so a
        // surplus of 2^-20 in the edge keeps what is within `distance` less than 0.5 apart.
        low_ = low;
        edge_ = std::max({0.5 * distance * (1.0 + 0x1p-20), extent * 0x1p-20, 1e-300});
    }

    /// The cubes that may hold a point within reach of `p`; the first is its own.
    [[nodiscard]] std::array<std::uint64_t, 8> around(const point3& p) const {
        std::array<std::uint64_t, 3> own{};
        std::array<std::uint64_t, 3> side{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = (p[axis] * 0.25 - low_[axis]) / edge_;
            const double whole = std::floor(at);
            own[axis] = static_cast<std::uint64_t>(whole) + 1;  // room for the side below
            side[axis] = at - whole < 0.5 ? own[axis] - 1 : own[axis] + 1;
        }
        std::array<std::uint64_t, 8> keys{};
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const std::uint64_t x = (i & 1) != 0 ? side[0] : own[0];
            const std::uint64_t y = (i & 2) != 0 ? side[1] : own[1];
            const std::uint64_t z = (i & 4) != 0 ? side[2] : own[2];
            keys[i] = x << 42 | y << 21 | z;
        }
        return keys;
    }

  private:
    std::array<double, 3> low_{};
    double edge_ = 1.0;
};

/// Points by cube: open addressing, a list of points behind each key.
class points_by_cell {
  public:
    explicit points_by_cell(std::size_t count)
        : slots_(std::bit_ceil(count + count / 2 + 2)), next_(count, nobody) {}

    void add(std::uint64_t key, std::uint32_t point) {
        slot& s = slots_[find(key)];
        s.key = key;
        next_[point] = s.head;
        s.head = point;
    }

    template <class Visit>
    void visit(std::uint64_t key, Visit&& visit_point) const {
        for (std::uint32_t i = slots_[find(key)].head; i != nobody; i = next_[i]) visit_point(i);
    }

  private:
    struct slot {
        std::uint64_t key = 0;
        std::uint32_t head = nobody;
    };

    [[nodiscard]] std::size_t find(std::uint64_t key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20) & mask;
        while (slots_[at].head != nobody && slots_[at].key != key) at = (at + 1) & mask;
        return at;
    }

    std::vector<slot> slots_;
    std::vector<std::uint32_t> next_;
};

/// Whether two points may be put together.
class matcher {
  public:
    matcher(points_view points, const weld_options& options)
        : points_(points), options_(&options), within_(options.tolerance) {}

    [[nodiscard]] bool operator()(std::uint32_t i, std::uint32_t j) const {
        return (options_->kind.empty() || options_->kind[i] == options_->kind[j]) &&
               within_.holds(points_[i], points_[j]) && (!options_->agree || options_->agree(i, j));
    }

  private:
    points_view points_;
    const weld_options* options_;
    detail::reach within_;
};

/// The kept point that each point belongs to.
std::vector<std::uint32_t> leaders(points_view points, const weld_options& options) {
    std::vector<std::uint32_t> leader_of(points.size());
    const cells grid(points, options.tolerance);
    const matcher match(points, options);
    points_by_cell kept(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        leader_of[i] = i;
        if (!finite(points[i])) continue;
        std::uint32_t best = nobody;
        const auto keys = grid.around(points[i]);
        for (const std::uint64_t key : keys)
            kept.visit(key, [&](std::uint32_t other) {
                if (!match(i, other)) return;
                const int order =
                    best == nobody ? -1
                                   : detail::reach::compare(points[i], points[other], points[best]);
                if (order < 0 || (order == 0 && other < best)) best = other;
            });
        if (best == nobody)
            kept.add(keys[0], i);
        else
            leader_of[i] = best;
    }
    return leader_of;
}

/// The earliest point of the chain that each point is part of.
std::vector<std::uint32_t> roots(points_view points, const weld_options& options) {
    detail::union_find sets(points.size());
    const cells grid(points, options.tolerance);
    const matcher match(points, options);
    points_by_cell earlier(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (!finite(points[i])) continue;
        const auto keys = grid.around(points[i]);
        for (const std::uint64_t key : keys)
            earlier.visit(key, [&](std::uint32_t other) {
                if (sets.root(i) != sets.root(other) && match(i, other)) sets.join(i, other);
            });
        earlier.add(keys[0], i);
    }
    std::vector<std::uint32_t> root_of(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) root_of[i] = sets.root(i);
    return root_of;
}

void check(points_view points, const weld_options& options) {
    if (!(options.tolerance >= 0.0) || !std::isfinite(options.tolerance))
        throw std::invalid_argument(
            "tf::weld_points: the tolerance must be finite and not negative");
    if (points.size() >= nobody)
        throw std::invalid_argument("tf::weld_points: more than 2^32 - 2 points");
    if (!options.kind.empty() && options.kind.size() != points.size())
        throw std::invalid_argument("tf::weld_points: " + std::to_string(options.kind.size()) +
                                    " kinds for " + std::to_string(points.size()) + " points");
}

}  // namespace

point_groups weld_points(points_view points, const weld_options& options) {
    check(points, options);
    if (options.progress && !options.progress(0.0)) return {{}, {}, true};
    point_groups result;
    result.group_of_point =
        options.rule == weld_rule::first ? leaders(points, options) : roots(points, options);
    // A first point comes before all others of its group.
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::uint32_t first = result.group_of_point[i];
        if (first == i) {
            result.group_of_point[i] = static_cast<std::uint32_t>(result.first_of_group.size());
            result.first_of_group.push_back(i);
        } else {
            result.group_of_point[i] = result.group_of_point[first];
        }
    }
    if (options.progress && !options.progress(1.0)) return {{}, {}, true};
    return result;
}

mesh join_groups(mesh_view mesh, const point_groups& groups) {
    if (groups.group_of_point.size() != mesh.points.size())
        throw std::invalid_argument("tf::join_groups: groups of " +
                                    std::to_string(groups.group_of_point.size()) + " points for " +
                                    std::to_string(mesh.points.size()));
    detail::check_faces("join_groups", mesh.points.size(), mesh.faces);
    tf::mesh result;
    result.points.reserve(groups.first_of_group.size());
    for (const std::uint32_t i : groups.first_of_group) result.points.push_back(mesh.points[i]);
    result.faces.reserve(mesh.faces.size());
    for (const face& f : mesh.faces)
        result.faces.push_back({groups.group_of_point[f[0]], groups.group_of_point[f[1]],
                                groups.group_of_point[f[2]]});
    return result;
}

}  // namespace tf
