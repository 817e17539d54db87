#include <libmesh/exact/filter.hpp>
#include <libmesh/intersect/pair_filter.hpp>

#include <algorithm>
#include <array>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/intersect/pair_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TREEFORM_PAIR_FILTER_ONCE
#define TREEFORM_PAIR_FILTER_ONCE
namespace treeform::detail::intersect {
namespace {

/// Class and corners by the equality of corner numbers: bit 3r + i of the index says that corner i
/// of a is corner i + r (mod 3) of b.
struct sharing {
    std::uint32_t in_class, corners;
};

constexpr auto sharing_of = [] {
    std::array<sharing, 512> table{};
    for (unsigned code = 0; code < 512; ++code) {
        unsigned in_a = 0, in_b = 0;
        for (unsigned r = 0; r < 3; ++r)
            for (unsigned i = 0; i < 3; ++i)
                if ((code >> (3 * r + i) & 1U) != 0) {
                    in_a |= 1U << i;
                    in_b |= 1U << ((i + r) % 3);
                }
        const int shared_a = std::popcount(in_a), shared_b = std::popcount(in_b);
        sharing entry{candidate_classes::other, 0};
        if (shared_a == 0) entry.in_class = candidate_classes::separate;
        if (shared_a == 1 && shared_b == 1)
            entry = {candidate_classes::corner,
                     candidate::corners(static_cast<std::uint32_t>(std::countr_zero(in_a)),
                                        static_cast<std::uint32_t>(std::countr_zero(in_b)))};
        if (shared_a == 2 && shared_b == 2)
            entry = {candidate_classes::edge,
                     candidate::corners(static_cast<std::uint32_t>(std::countr_one(in_a)),
                                        static_cast<std::uint32_t>(std::countr_one(in_b)))};
        table[code] = entry;
    }
    return table;
}();

}  // namespace
}  // namespace treeform::detail::intersect
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::intersect::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// The index into `sharing_of`.
unsigned sharing_code(const numbered_face& a, const numbered_face& b) {
#if HWY_TARGET == HWY_SCALAR
    unsigned code = 0;
    for (unsigned r = 0; r < 3; ++r)
        for (unsigned i = 0; i < 3; ++i)
            code |= static_cast<unsigned>(a[i] == b[(r + i) % 3]) << (3 * r + i);
    return code;
#else
    const hn::FixedTag<std::uint32_t, 4> d;
    constexpr std::int32_t turned_once[] = {1, 2, 0, 3};
    constexpr std::int32_t turned_twice[] = {2, 0, 1, 3};
    const auto corners = hn::LoadU(d, a.data());
    const auto others = hn::LoadU(d, b.data());
    const auto equal_bits = [&](auto turned) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Eq(corners, turned), bits);
        return bits[0] & 7U;
    };
    return equal_bits(others) |
           equal_bits(hn::TableLookupLanes(others, hn::SetTableIndices(d, turned_once))) << 3 |
           equal_bits(hn::TableLookupLanes(others, hn::SetTableIndices(d, turned_twice))) << 6;
#endif
}

void sort_candidates(const candidate_block& block, const numbered_face* faces,
                     candidate_classes& classes) {
    std::array<candidate*, 4> end;
    for (std::size_t which = 0; which < end.size(); ++which)
        end[which] = classes.list[which].data();
    constexpr std::size_t ahead = 16;  // faces of a chunk before are in no cache
    const std::size_t size = block.first.size();
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t next = std::min(i + ahead, size - 1);
        __builtin_prefetch(faces + block.first[next]);
        __builtin_prefetch(faces + block.second[next]);
        const sharing entry =
            sharing_of[sharing_code(faces[block.first[i]], faces[block.second[i]])];
        *end[entry.in_class]++ = candidate(static_cast<std::uint32_t>(i), entry.corners);
    }
    for (std::size_t which = 0; which < end.size(); ++which)
        classes.count[which] = static_cast<std::size_t>(end[which] - classes.list[which].data());
}

using lanes_tag = hn::CappedTag<double, 8>;
using lanes = hn::Vec<lanes_tag>;
using lanes_mask = hn::Mask<lanes_tag>;

struct vec {
    lanes x, y, z;
};

vec load(const pair_batch& batch, std::size_t corner, std::size_t i) {
    const lanes_tag d;
    return {hn::Load(d, batch.at[corner][0] + i), hn::Load(d, batch.at[corner][1] + i),
            hn::Load(d, batch.at[corner][2] + i)};
}

vec operator-(const vec& a, const vec& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

vec abs(const vec& a) { return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)}; }

lanes dot(const vec& a, const vec& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// Which lanes lie certainly ahead of a plane, and which certainly behind.
struct sides {
    lanes_mask ahead, behind;
};

/// The plane through the origin along u and v: its normal, and the permanent of each component.
class plane {
  public:
    plane(const vec& u, const vec& v) {
        component(u.y, v.z, u.z, v.y, normal_.x, permanent_.x);
        component(u.z, v.x, u.x, v.z, normal_.y, permanent_.y);
        component(u.x, v.y, u.y, v.x, normal_.z, permanent_.z);
    }

    /// \source the bound of libmesh/exact/detail/filter.hpp for `orient3d`
    [[nodiscard]] sides of(const vec& w) const {
        const lanes_tag d;
        const lanes value = dot(normal_, w);
        const lanes permanent = dot(permanent_, abs(w));
        const lanes error =
            hn::Mul(hn::Set(d, exact::error_factor<exact::orient3d_polynomial>), permanent);
        const lanes_mask known = hn::Ge(permanent, hn::Set(d, exact::least_permanent));
        return {hn::And(known, hn::Gt(value, error)),
                hn::And(known, hn::Lt(value, hn::Neg(error)))};
    }

    /// The sides by the signs of the normal's components: how u and v turn, seen along each axis.
    /// \source the bound of libmesh/exact/detail/filter.hpp for `orient2d`
    [[nodiscard]] std::array<sides, 3> turns() const {
        return {turn(normal_.x, permanent_.x), turn(normal_.y, permanent_.y),
                turn(normal_.z, permanent_.z)};
    }

  private:
    static sides turn(lanes value, lanes permanent) {
        const lanes_tag d;
        const lanes error =
            hn::Mul(hn::Set(d, exact::error_factor<exact::orient2d_polynomial>), permanent);
        const lanes_mask known = hn::Ge(permanent, hn::Set(d, exact::least_permanent));
        return {hn::And(known, hn::Gt(value, error)),
                hn::And(known, hn::Lt(value, hn::Neg(error)))};
    }
    static void component(lanes uy, lanes vz, lanes uz, lanes vy, lanes& normal, lanes& permanent) {
        const lanes p = hn::Mul(uy, vz);
        const lanes q = hn::Mul(uz, vy);
        normal = hn::Sub(p, q);
        permanent = hn::Add(hn::Abs(p), hn::Abs(q));
    }

    vec normal_;
    vec permanent_;
};

lanes_mask same_side(const sides& a, const sides& b) {
    return hn::Or(hn::And(a.ahead, b.ahead), hn::And(a.behind, b.behind));
}
lanes_mask same_side(const sides& a, const sides& b, const sides& c) {
    return hn::Or(hn::And(hn::And(a.ahead, b.ahead), c.ahead),
                  hn::And(hn::And(a.behind, b.behind), c.behind));
}
lanes_mask opposite_sides(const sides& a, const sides& b) {
    return hn::Or(hn::And(a.ahead, b.behind), hn::And(a.behind, b.ahead));
}

std::uint64_t bits_at(lanes_mask mask, std::size_t i) {
    const lanes_tag d;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return static_cast<std::uint64_t>(bits[0] & ((1U << hn::Lanes(d)) - 1)) << i;
}

/// Two triangles on a common edge have no more in common unless they are coplanar, nor if seen
/// along some axis they lie on either side of it: neighbors in a flat part of a surface.
batch_verdict edge_pairs(const pair_batch& batch, std::size_t count) {
    batch_verdict verdict;
    for (std::size_t i = 0; i < count; i += hn::Lanes(lanes_tag())) {
        const vec u = load(batch, 0, i);
        const vec edge = load(batch, 1, i) - u;
        const vec to_b = load(batch, 3, i) - u;
        const plane of_a(edge, load(batch, 2, i) - u);
        const sides b = of_a.of(to_b);
        lanes_mask apart = hn::Or(b.ahead, b.behind);
        if (!hn::AllTrue(lanes_tag(), apart)) {
            const auto turns_a = of_a.turns();
            const auto turns_b = plane(edge, to_b).turns();
            for (std::size_t k = 0; k < 3; ++k)
                apart = hn::Or(apart, opposite_sides(turns_a[k], turns_b[k]));
        }
        verdict.apart |= bits_at(apart, i);
    }
    return verdict;
}

/// Triangles p a1 a2 and p b1 b2, relative to p: where an edge at p separates them, seen along an
/// axis. They then meet in p alone, as its triangle has an area seen so and the other one no point
/// on the edge's line but p.
lanes_mask separated_by_an_edge(const vec& a1, const vec& a2, const vec& b1, const vec& b2) {
    const auto a12 = plane(a1, a2).turns(), b12 = plane(b1, b2).turns();
    const auto a1b1 = plane(a1, b1).turns(), a1b2 = plane(a1, b2).turns();
    const auto a2b1 = plane(a2, b1).turns(), a2b2 = plane(a2, b2).turns();
    const auto along = [&](std::size_t k) {
        const lanes_mask by_a1 =
            hn::And(opposite_sides(a12[k], a1b1[k]), opposite_sides(a12[k], a1b2[k]));
        const lanes_mask by_a2 = same_side(a12[k], a2b1[k], a2b2[k]);
        const lanes_mask by_b1 = same_side(b12[k], a1b1[k], a2b1[k]);
        const lanes_mask by_b2 =
            hn::And(opposite_sides(b12[k], a1b2[k]), opposite_sides(b12[k], a2b2[k]));
        return hn::Or(hn::Or(by_a1, by_a2), hn::Or(by_b1, by_b2));
    };
    return hn::Or(along(0), hn::Or(along(1), along(2)));
}

/// Triangles p a1 a2 and p b1 b2. When either plane has the other triangle strictly on one side
/// except for p, they meet in p alone. Otherwise each cuts the line of both planes in a segment
/// that starts at p, and those overlap when they run the same way. Relative to p, with D1 = det(b1,
/// b2, a1), D2 = det(b1, b2, a2) and E2 = det(a1, a2, b2): the point of the line on a1 a2 is (D1 a2
/// - D2 a1) / (D1 - D2) = alpha b1 + beta b2, where taking det(., b2, a1) gives alpha = E2 / (D1 -
/// D2); D1 - D2 has the sign of D1. The point of the line on b1 b2 has positive coefficients, so
/// the segments run the same way if and only if D1 and E2 have the same sign.
batch_verdict corner_pairs(const pair_batch& batch, std::size_t count) {
    batch_verdict verdict;
    for (std::size_t i = 0; i < count; i += hn::Lanes(lanes_tag())) {
        const vec p = load(batch, 0, i);
        const vec a1 = load(batch, 1, i) - p;
        const vec a2 = load(batch, 2, i) - p;
        const vec b1 = load(batch, 3, i) - p;
        const vec b2 = load(batch, 4, i) - p;
        const plane of_a(a1, a2);
        const plane of_b(b1, b2);
        const sides e1 = of_a.of(b1);
        const sides e2 = of_a.of(b2);
        const sides d1 = of_b.of(a1);
        const sides d2 = of_b.of(a2);
        const lanes_mask both_cross = hn::And(opposite_sides(e1, e2), opposite_sides(d1, d2));
        const lanes_mask same_way = same_side(d1, e2);
        lanes_mask apart =
            hn::Or(hn::Or(same_side(e1, e2), same_side(d1, d2)), hn::AndNot(same_way, both_cross));
        const lanes_mask pierce = hn::And(both_cross, same_way);
        if (!hn::AllTrue(lanes_tag(), hn::Or(apart, pierce)))
            apart = hn::Or(apart, hn::AndNot(pierce, separated_by_an_edge(a1, a2, b1, b2)));
        verdict.apart |= bits_at(apart, i);
        verdict.pierce |= bits_at(pierce, i);
    }
    return verdict;
}

/// Three corners and where each lies of the other triangle's plane.
struct seen_triangle {
    std::array<vec, 3> corner;
    std::array<sides, 3> side;
};

vec either(lanes_mask first, const vec& a, const vec& b) {
    return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y),
            hn::IfThenElse(first, a.z, b.z)};
}

/// Turned so that the first corner is alone on its side of the other plane, where there is such a
/// corner; says whether that side is behind.
lanes_mask turn_lone_first(seen_triangle& t) {
    const lanes_mask lone_1 = same_side(t.side[2], t.side[0]);
    const lanes_mask lone_2 = same_side(t.side[0], t.side[1]);
    const auto [c0, c1, c2] = t.corner;
    t.corner = {either(lone_1, c1, either(lone_2, c2, c0)),
                either(lone_1, c2, either(lone_2, c0, c1)),
                either(lone_1, c0, either(lone_2, c1, c2))};
    const auto behind = [&](std::size_t i) { return t.side[i].behind; };
    return hn::Or(
        hn::And(lone_1, behind(1)),
        hn::Or(hn::And(lone_2, behind(2)), hn::AndNot(hn::Or(lone_1, lone_2), behind(0))));
}

void exchange(lanes_mask where, vec& a, vec& b) {
    const vec old = a;
    a = either(where, b, a);
    b = either(where, old, b);
}

/// Of triangles that both have corners strictly on both sides of the other's plane: each cuts the
/// line of both planes in a segment, and the triangles meet where the segments overlap. With the
/// lone corners p of a and q of b first, and both ahead of the other plane (or its orientation
/// exchanged), they overlap if and only if det(p, a1, q, b1) <= 0 and det(p, a2, b2, q) <= 0, in
/// more than a point if both are negative.
///
/// \source Devillers and Guigue, INRIA RR-4488, section 4
struct line_verdict {
    lanes_mask apart, crossing;
};
line_verdict compare_on_line(seen_triangle& a, seen_triangle& b) {
    const lanes_mask a_behind = turn_lone_first(a);
    const lanes_mask b_behind = turn_lone_first(b);
    exchange(a_behind, b.corner[1], b.corner[2]);
    exchange(b_behind, a.corner[1], a.corner[2]);
    const vec& p = a.corner[0];
    const vec to_q = b.corner[0] - p;
    const sides first = plane(a.corner[1] - p, to_q).of(b.corner[1] - p);
    const sides second = plane(a.corner[2] - p, b.corner[2] - p).of(to_q);
    return {hn::Or(first.ahead, second.ahead), hn::And(first.behind, second.behind)};
}

lanes_mask cut(const std::array<sides, 3>& s) {
    const auto certain = [&](std::size_t i) { return hn::Or(s[i].ahead, s[i].behind); };
    return hn::AndNot(same_side(s[0], s[1], s[2]),
                      hn::And(hn::And(certain(0), certain(1)), certain(2)));
}

batch_verdict separate_pairs(const pair_batch& batch, std::size_t count) {
    batch_verdict verdict;
    for (std::size_t i = 0; i < count; i += hn::Lanes(lanes_tag())) {
        seen_triangle a, b;
        for (std::size_t k = 0; k < 3; ++k) {
            a.corner[k] = load(batch, k, i);
            b.corner[k] = load(batch, k + 3, i);
        }
        const auto normal = [](const std::array<vec, 3>& t) {
            return plane(t[1] - t[0], t[2] - t[0]);
        };
        const plane of_a = normal(a.corner);
        const plane of_b = normal(b.corner);
        for (std::size_t k = 0; k < 3; ++k) {
            a.side[k] = of_b.of(a.corner[k] - b.corner[0]);
            b.side[k] = of_a.of(b.corner[k] - a.corner[0]);
        }
        verdict.apart |= bits_at(hn::Or(same_side(a.side[0], a.side[1], a.side[2]),
                                        same_side(b.side[0], b.side[1], b.side[2])),
                                 i);
        const lanes_mask both_cut = hn::And(cut(a.side), cut(b.side));
        if (hn::AllFalse(lanes_tag(), both_cut)) continue;
        const line_verdict on_line = compare_on_line(a, b);
        verdict.apart |= bits_at(hn::And(both_cut, on_line.apart), i);
        verdict.pierce |= bits_at(hn::And(both_cut, on_line.crossing), i);
    }
    return verdict;
}

}  // namespace
}  // namespace treeform::detail::intersect::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::intersect {

HWY_EXPORT(sort_candidates);
HWY_EXPORT(edge_pairs);
HWY_EXPORT(corner_pairs);
HWY_EXPORT(separate_pairs);

void sort_by_class(const candidate_block& block, const numbered_face* faces,
                   candidate_classes& classes) {
    HWY_DYNAMIC_DISPATCH(sort_candidates)(block, faces, classes);
}
template <>
batch_verdict filter_pairs<candidate_classes::edge>(const pair_batch& batch, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(edge_pairs)(batch, count);
}
template <>
batch_verdict filter_pairs<candidate_classes::corner>(const pair_batch& batch, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(corner_pairs)(batch, count);
}
template <>
batch_verdict filter_pairs<candidate_classes::separate>(const pair_batch& batch,
                                                        std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(separate_pairs)(batch, count);
}

}  // namespace treeform::detail::intersect
#endif
