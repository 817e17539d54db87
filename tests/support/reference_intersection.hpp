#pragma once
/// \file
/// The intersection of two triangles the slow, plain way: one triangle is cut down by the
/// half-spaces that make up the other, in exact arithmetic, and what is left is named by looking
/// where each point lies. Shares nothing with the library but the types of the answer.
///
/// `Integer` is a signed type that does not overflow: std::int64_t for coordinates up to 4 or so,
/// a big integer otherwise. `reduce(point)` may divide out common factors.

#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace treeform::test {

template <class Integer>
using vector_of = std::array<Integer, 3>;
template <class Integer>
using triangle_of = std::array<vector_of<Integer>, 3>;

inline triangle_of<std::int64_t> integral(const triangle3& t) {
    triangle_of<std::int64_t> result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            result[i][axis] = static_cast<std::int64_t>(t[i][axis]);
    return result;
}

/// The point (x / w, y / w, z / w), w > 0.
template <class Integer>
struct homogeneous {
    vector_of<Integer> x;
    Integer w;
};

inline void reduce(homogeneous<std::int64_t>& p) {
    const std::int64_t d = std::gcd(std::gcd(p.x[0], p.x[1]), std::gcd(p.x[2], p.w));
    for (auto& x : p.x) x /= d;
    p.w /= d;
}

struct reference_contact {
    bool coplanar = false;
    bool crossing = false;
    bool degenerate = false;         ///< at least one of the two is a segment or a point
    std::vector<feature_pair> ends;  ///< an area's in the order `a` runs
};

template <class Integer>
class reference_intersection {
  public:
    using vec = vector_of<Integer>;
    using triangle = triangle_of<Integer>;
    using point = homogeneous<Integer>;
    using polygon = std::vector<point>;

    reference_intersection(triangle a, triangle b) : a_(std::move(a)), b_(std::move(b)) {
        const bool flat_a = is_zero(normal(a_));
        const bool flat_b = is_zero(normal(b_));
        answer_.degenerate = flat_a || flat_b;
        points_ = flat_b && !flat_a ? common(b_, a_) : common(a_, b_);
        for (const point& p : points_) answer_.ends.push_back({name(p, a_), name(p, b_)});
        answer_.coplanar = coplanar();
        answer_.crossing =
            !answer_.degenerate && points_.size() == 2 && straddles(a_, b_) && straddles(b_, a_);
    }

    [[nodiscard]] const reference_contact& answer() const { return answer_; }
    [[nodiscard]] const polygon& points() const { return points_; }  ///< where the ends are
    [[nodiscard]] const triangle& a() const { return a_; }
    [[nodiscard]] const triangle& b() const { return b_; }

    static bool is_zero(const vec& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }
    static vec normal(const triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

    /// The corners without which the convex hull would be smaller: 1, 2 or 3.
    static polygon extreme_corners(const triangle& t) {
        const auto [low, high] = std::minmax_element(t.begin(), t.end());
        if (*low == *high) return {{t[0], 1}};
        if (is_zero(normal(t))) return {{*low, 1}, {*high, 1}};
        return {{t[0], 1}, {t[1], 1}, {t[2], 1}};
    }

  private:
    /// { x : n . (x - at) >= 0 }
    struct half_space {
        vec n;
        vec at;
        [[nodiscard]] Integer value(const point& p) const {
            Integer sum = 0;
            for (std::size_t i = 0; i < 3; ++i) sum += n[i] * (p.x[i] - at[i] * p.w);
            return sum;
        }
    };

    static vec minus(const vec& p, const vec& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
    static vec negative(const vec& v) { return {-v[0], -v[1], -v[2]}; }
    static vec cross(const vec& p, const vec& q) {
        return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    }
    static Integer dot(const vec& p, const vec& q) {
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    }
    static vec unit(std::size_t axis) {
        vec v{0, 0, 0};
        v[axis] = 1;
        return v;
    }

    static std::vector<half_space> half_spaces(const triangle& t) {
        std::vector<half_space> list;
        const auto both = [&](const vec& n, const vec& at) {
            list.push_back({n, at});
            list.push_back({negative(n), at});
        };
        const vec n = normal(t);
        const polygon corners = extreme_corners(t);
        if (corners.size() == 3) {
            both(n, t[0]);
            for (std::size_t i = 0; i < 3; ++i)
                list.push_back({cross(n, minus(t[(i + 1) % 3], t[i])), t[i]});
        } else if (corners.size() == 2) {
            const vec direction = minus(corners[1].x, corners[0].x);
            for (std::size_t axis = 0; axis < 3; ++axis)
                both(cross(direction, unit(axis)), corners[0].x);
            list.push_back({direction, corners[0].x});
            list.push_back({negative(direction), corners[1].x});
        } else {
            for (std::size_t axis = 0; axis < 3; ++axis) both(unit(axis), t[0]);
        }
        return list;
    }

    static polygon cut(const polygon& body, const half_space& by) {
        std::vector<Integer> value;
        for (const point& p : body) value.push_back(by.value(p));
        polygon rest;
        for (std::size_t i = 0; i < body.size(); ++i) {
            const std::size_t k = (i + 1) % body.size();
            if (value[i] >= 0) rest.push_back(body[i]);
            if (value[i] > 0 && value[k] < 0)
                rest.push_back(between(body[k], body[i], value[k], value[i]));
            if (value[i] < 0 && value[k] > 0)
                rest.push_back(between(body[i], body[k], value[i], value[k]));
        }
        return rest;
    }

    /// Where the value vanishes between `below` and `above`.
    static point between(const point& below, const point& above, const Integer& value_below,
                         const Integer& value_above) {
        point p;
        for (std::size_t i = 0; i < 3; ++i)
            p.x[i] = value_above * below.x[i] - value_below * above.x[i];
        p.w = value_above * below.w - value_below * above.w;
        reduce(p);
        return p;
    }

    static bool same(const point& p, const point& q) {
        for (std::size_t i = 0; i < 3; ++i)
            if (p.x[i] * q.w != q.x[i] * p.w) return false;
        return true;
    }

    static polygon common(const triangle& body, const triangle& by) {
        polygon rest = extreme_corners(body);
        for (const half_space& h : half_spaces(by)) {
            if (rest.empty()) break;
            rest = cut(rest, h);
        }
        polygon distinct;
        for (const point& p : rest)
            if (std::none_of(distinct.begin(), distinct.end(),
                             [&](const point& q) { return same(p, q); }))
                distinct.push_back(p);
        return distinct;
    }

    /// The point is known to lie in `t`.
    static triangle_feature name(const point& p, const triangle& t) {
        for (std::size_t i = 0; i < 3; ++i)
            if (same(p, {t[i], 1})) return static_cast<triangle_feature>(i);
        for (std::size_t i = 0; i < 3; ++i) {
            const vec edge = minus(t[(i + 1) % 3], t[i]);
            vec offset;
            for (std::size_t axis = 0; axis < 3; ++axis)
                offset[axis] = p.x[axis] - t[i][axis] * p.w;
            const Integer along = dot(offset, edge);
            if (is_zero(cross(offset, edge)) && along > 0 && along < dot(edge, edge) * p.w)
                return static_cast<triangle_feature>(3 + i);
        }
        return triangle_feature::interior;
    }

    static int side(const triangle& plane, const vec& p) {
        const Integer value = dot(normal(plane), minus(p, plane[0]));
        return value > 0 ? 1 : value < 0 ? -1 : 0;
    }
    static bool straddles(const triangle& t, const triangle& plane) {
        const auto [low, high] =
            std::minmax({side(plane, t[0]), side(plane, t[1]), side(plane, t[2])});
        return low < 0 && high > 0;
    }
    /// All six corners in one plane: every four of them span no volume.
    [[nodiscard]] bool coplanar() const {
        const auto contains = [](const triangle& plane, const triangle& t) {
            return side(plane, t[0]) == 0 && side(plane, t[1]) == 0 && side(plane, t[2]) == 0;
        };
        if (!is_zero(normal(a_))) return contains(a_, b_);
        if (!is_zero(normal(b_))) return contains(b_, a_);
        const polygon p = extreme_corners(a_);
        const polygon q = extreme_corners(b_);
        return side({p.front().x, p.back().x, q.front().x}, q.back().x) == 0;
    }

    triangle a_;
    triangle b_;
    polygon points_;
    reference_contact answer_;
};

/// Whether `found` is the reference's answer: equal flags, the same ends, and for an area
/// the same cyclic order.
inline bool agrees(const triangle_contact& found, const reference_contact& expected) {
    if (found.coplanar != expected.coplanar || found.crossing != expected.crossing ||
        found.count != expected.ends.size())
        return false;
    const std::size_t n = expected.ends.size();
    const auto matches_from = [&](std::size_t first) {
        for (std::size_t i = 0; i < n; ++i)
            if (found.ends[(first + i) % n] != expected.ends[i]) return false;
        return true;
    };
    for (std::size_t first = 0; first < n; ++first)
        if (matches_from(first)) return true;
    return n == 0;
}

}  // namespace treeform::test
