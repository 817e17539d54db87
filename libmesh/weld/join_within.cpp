#include <libmesh/exact/predicates.hpp>
#include <libmesh/weld/join_within.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace tf {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

bool finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

double rounded_squared_distance(const point3& a, const point3& b) {
    const double x = a.x - b.x;
    const double y = a.y - b.y;
    const double z = a.z - b.z;
    return x * x + y * y + z * z;
}

/// The sum of three rounded squares of rounded differences is off by a factor within
/// (1 +- u)^5, u = 2^-53, so comparing two such numbers (or one with a rounded square) that differ
/// by more than 1 part in 2^48 cannot err. Underflow and overflow leave the trusted range.
enum class order { less, more, unsure };
order compare_rounded(double a, double b) {
    constexpr double margin = 1.0 + 0x1p-48;
    constexpr double least = 0x1p-960;
    constexpr double greatest = 0x1p1000;
    if (!(a < greatest && b < greatest) || !(a > least || b > least)) return order::unsure;
    if (a * margin < b) return order::less;
    if (b * margin < a) return order::more;
    return order::unsure;
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

/// Kept points by cube: open addressing, a list of points behind each key.
class kept_points {
  public:
    explicit kept_points(std::size_t count)
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

/// The exact comparisons of one distance.
class reach {
  public:
    explicit reach(double distance) : distance_(distance), square_(distance * distance) {}

    [[nodiscard]] bool holds(const point3& a, const point3& b) const {
        const order known = compare_rounded(rounded_squared_distance(a, b), square_);
        if (known != order::unsure) return known == order::less;
        return compare_distance(a, b, {}, {distance_, 0.0, 0.0}) <= 0;
    }

    /// Whether `a` is nearer to `p` than `b` is.
    [[nodiscard]] static bool nearer(const point3& p, const point3& a, const point3& b) {
        const order known =
            compare_rounded(rounded_squared_distance(p, a), rounded_squared_distance(p, b));
        if (known != order::unsure) return known == order::less;
        return compare_distance(p, a, p, b) < 0;
    }

  private:
    double distance_;
    double square_;
};

}  // namespace

joined_points find_points_within(points_view points, double distance) {
    if (!(distance >= 0.0) || !std::isfinite(distance))
        throw std::invalid_argument("find_points_within: distance must be finite and not negative");
    if (points.size() >= nobody)
        throw std::invalid_argument("find_points_within: more than 2^32 - 1 points");

    joined_points result;
    result.new_of_old.resize(points.size());
    const cells grid(points, distance);
    const reach within(distance);
    kept_points kept(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const point3& p = points[i];
        std::uint32_t leader = nobody;
        if (finite(p)) {
            const auto keys = grid.around(p);
            for (const std::uint64_t key : keys) {
                kept.visit(key, [&](std::uint32_t other) {
                    if (!within.holds(p, points[other])) return;
                    if (leader == nobody || reach::nearer(p, points[other], points[leader]) ||
                        (other < leader && !reach::nearer(p, points[leader], points[other])))
                        leader = other;
                });
            }
            if (leader == nobody) kept.add(keys[0], i);
        }
        if (leader == nobody) {
            result.new_of_old[i] = static_cast<std::uint32_t>(result.first_of_new.size());
            result.first_of_new.push_back(i);
        } else {
            result.new_of_old[i] = result.new_of_old[leader];
        }
    }
    return result;
}

mesh join_points_within(mesh_view mesh, double distance) {
    const joined_points joined = find_points_within(mesh.points, distance);
    tf::mesh result;
    result.points.reserve(joined.first_of_new.size());
    for (const std::uint32_t old : joined.first_of_new) result.points.push_back(mesh.points[old]);
    result.faces.reserve(mesh.faces.size());
    for (const face& f : mesh.faces)
        result.faces.push_back(
            {joined.new_of_old[f[0]], joined.new_of_old[f[1]], joined.new_of_old[f[2]]});
    return result;
}

}  // namespace tf
