#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/nearness/bounding_cylinders.hpp>
#include <treeform/tree/detail/near_query.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/nearness/bounding_cylinders.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TREEFORM_NODE_DISCS_ONCE
#define TREEFORM_NODE_DISCS_ONCE
namespace treeform::detail::nearness {
namespace {

/// One cylinder, its center in the common frame.
struct placed_cylinder {
    float center[3];
    float slack;  ///< how far that is off, the sum over the axes
    float normal[3];
    float half;
    float radius;
};

/// A linear map of cylinders into the common frame.
struct cylinder_map {
    float linear[3][3];
    float size;    ///< the sum of the magnitudes of the entries
    float square;  ///< for a rotation scaled by s: 1 / s^2
};

/// How far points reach along an axis from a center, and how far, squared, from that axis.
struct axial_extent {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    double squared = 0.0;
};

/// Where a cylinder is looked for: a center in the frame of the tree, and a normal of length 1.
struct cylinder_axis {
    double center[3];
    double normal[3];
};

}  // namespace
}  // namespace treeform::detail::nearness
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::nearness::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using doubles = hn::CappedTag<double, 8>;

void measure_blocks(const eight_triangles* begin, const eight_triangles* end,
                    const tree_frame<3>& frame, const cylinder_axis& axis, axial_extent& extent) {
    const doubles d;
    using vec = hn::Vec<doubles>;
    vec least = hn::Set(d, extent.least), most = hn::Set(d, extent.most);
    vec squared = hn::Set(d, extent.squared);
    for (const eight_triangles* block = begin; block != end; ++block)
        for (const auto& corner : block->at)
            for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
                vec q[3];
                vec along = hn::Zero(d);
                for (std::size_t k = 0; k < 3; ++k) {
                    q[k] = hn::Sub(hn::Load(d, corner[k] + i), hn::Set(d, frame.origin[k]));
                    q[k] =
                        hn::Sub(hn::Mul(q[k], hn::Set(d, frame.scale)), hn::Set(d, axis.center[k]));
                    along = hn::Add(along, hn::Mul(q[k], hn::Set(d, axis.normal[k])));
                }
                vec square = hn::Zero(d);
                for (std::size_t k = 0; k < 3; ++k) {
                    const vec off = hn::Sub(q[k], hn::Mul(along, hn::Set(d, axis.normal[k])));
                    square = hn::Add(square, hn::Mul(off, off));
                }
                least = hn::Min(least, along);
                most = hn::Max(most, along);
                squared = hn::Max(squared, square);
            }
    extent = {hn::GetLane(hn::MinOfLanes(d, least)), hn::GetLane(hn::MaxOfLanes(d, most)),
              hn::GetLane(hn::MaxOfLanes(d, squared))};
}

using floats = hn::CappedTag<float, 8>;
using lanes = hn::Vec<floats>;

struct vector3 {
    lanes of[3];
};

HWY_INLINE lanes dot(const vector3& a, const vector3& b) {
    return hn::MulAdd(a.of[0], b.of[0], hn::MulAdd(a.of[1], b.of[1], hn::Mul(a.of[2], b.of[2])));
}

/// A row of the map times x, or a column.
template <bool Back = false>
HWY_INLINE vector3 mapped(const cylinder_map& map, const vector3& x) {
    const floats d;
    vector3 result;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto entry = [&](std::size_t j) {
            return hn::Set(d, Back ? map.linear[j][k] : map.linear[k][j]);
        };
        result.of[k] = hn::MulAdd(entry(0), x.of[0],
                                  hn::MulAdd(entry(1), x.of[1], hn::Mul(entry(2), x.of[2])));
    }
    return result;
}

/// A cylinder a lane, about its center, and the map into the common frame.
struct cylinder_lanes {
    vector3 normal;
    lanes half, radius;
    const cylinder_map& map;
};

/// What of x lies along the normal, and the rest of it.
HWY_INLINE lanes split(const vector3& normal, const vector3& x, vector3& across) {
    const lanes along = dot(normal, x);
    for (std::size_t k = 0; k < 3; ++k) across.of[k] = hn::NegMulAdd(along, normal.of[k], x.of[k]);
    return along;
}

/// Near the point of a cylinder that is nearest to `to`, where the map is a rotation or the like;
/// any point will do. Both from the center, in the common frame.
HWY_INLINE vector3 near_point(const cylinder_lanes& cylinder, const vector3& to) {
    const floats d;
    vector3 back = mapped<true>(cylinder.map, to);
    for (auto& axis : back.of) axis = hn::Mul(axis, hn::Set(d, cylinder.map.square));
    vector3 across;
    const lanes along = split(cylinder.normal, back, across);
    const lanes within = hn::Max(hn::Neg(cylinder.half), hn::Min(along, cylinder.half));
    const lanes length = hn::Sqrt(hn::Max(dot(across, across), hn::Set(d, 1e-30F)));
    const lanes part = hn::Min(hn::Set(d, 1.0F), hn::Div(cylinder.radius, length));
    vector3 point;
    for (std::size_t k = 0; k < 3; ++k)
        point.of[k] = hn::MulAdd(within, cylinder.normal.of[k], hn::Mul(part, across.of[k]));
    return mapped(cylinder.map, point);
}

/// How far a cylinder reaches along `direction` from its center.
HWY_INLINE lanes reach_along(const cylinder_lanes& cylinder, const vector3& direction) {
    vector3 across;
    const lanes along = split(cylinder.normal, mapped<true>(cylinder.map, direction), across);
    return hn::MulAdd(cylinder.half, hn::Abs(along),
                      hn::Mul(cylinder.radius, hn::Sqrt(dot(across, across))));
}

HWY_INLINE vector3 minus(const vector3& a, const vector3& b) {
    return {{hn::Sub(a.of[0], b.of[0]), hn::Sub(a.of[1], b.of[1]), hn::Sub(a.of[2], b.of[2])}};
}

/// From one cylinder to another whose center is `gap` away, nearly where they are nearest; of
/// length 1, or 0 where nothing can be said.
HWY_INLINE vector3 direction_between(const cylinder_lanes& a, const cylinder_lanes& b,
                                     const vector3& gap) {
    const floats d;
    const vector3 on_a = near_point(a, gap);
    const vector3 on_b = near_point(b, minus(on_a, gap));
    vector3 direction = minus(gap, minus(on_a, on_b));
    const lanes square = dot(direction, direction);
    const lanes per_length =  // nothing can be said of a length that underflows
        hn::IfThenElseZero(hn::Gt(square, hn::Set(d, 1e-30F)),
                           hn::Div(hn::Set(d, 1.0F), hn::Sqrt(square)));
    for (auto& axis : direction.of) axis = hn::Mul(axis, per_length);
    return direction;
}

/// Eight cylinders against one. Along any direction v, of a length within 2^-20 of 1, the cylinders
/// are apart by what their centers are less what each reaches toward the other; the best v runs
/// between their nearest points, and a projection onto one and from there onto the other is close
/// to that.
///
/// With u = 2^-24, N the sum of the magnitudes of a map's entries and g the vector between the
/// centers: g is off by `slack`, the sum over the axes of what `frame_map` says of its points, and
/// by u |g|; products with v and their sum by 4 u |g|. A direction mapped back is off by 4 u N, its
/// parts along and across the normal by 8 u N more, and the normal is not of length 1 by 4 u; so a
/// reach is off by less than 32 u N (half + radius). The margin is 64 u of all that, and |v| and
/// the roundings of the square have 2^-17 for them. NaN, and differences of infinities, raise
/// nothing.
unsigned raise_eight(const eight_cylinders& cylinders, const frame_map<3>& frame,
                     const cylinder_map& map, const placed_cylinder& other,
                     const cylinder_map& map_of_other, float bound, float* squared) {
    const floats d;
    const std::size_t width = hn::Lanes(d);
    const cylinder_lanes that{
        {{hn::Set(d, other.normal[0]), hn::Set(d, other.normal[1]), hn::Set(d, other.normal[2])}},
        hn::Set(d, other.half),
        hn::Set(d, other.radius),
        map_of_other};
    unsigned within = 0;
    for (std::size_t i = 0; i < 8; i += width) {
        const auto load = [&](const float* row) { return hn::Load(d, row + i); };
        const cylinder_lanes cylinder{
            {{load(cylinders.normal[0]), load(cylinders.normal[1]), load(cylinders.normal[2])}},
            load(cylinders.half),
            load(cylinders.radius),
            map};
        vector3 center{
            {load(cylinders.center[0]), load(cylinders.center[1]), load(cylinders.center[2])}};
        lanes slack = hn::Set(d, other.slack);
        if (!frame.identity) {
            const vector3 from = center;
            center = mapped(map, from);
            for (std::size_t k = 0; k < 3; ++k) {
                center.of[k] = hn::Add(center.of[k], hn::Set(d, frame.offset[k]));
                slack = hn::Add(slack, hn::Set(d, frame.slack_offset[k]));
                for (std::size_t j = 0; j < 3; ++j)
                    slack = hn::MulAdd(hn::Set(d, frame.slack[k][j]), hn::Abs(from.of[j]), slack);
            }
        }
        const vector3 gap = minus({{hn::Set(d, other.center[0]), hn::Set(d, other.center[1]),
                                    hn::Set(d, other.center[2])}},
                                  center);
        const vector3 direction = direction_between(cylinder, that, gap);

        const lanes sizes =
            hn::MulAdd(hn::Set(d, map.size), hn::Add(cylinder.half, cylinder.radius),
                       hn::Set(d, map_of_other.size * (other.half + other.radius)));
        const lanes far =
            hn::Add(hn::Add(hn::Abs(gap.of[0]), hn::Abs(gap.of[1])), hn::Abs(gap.of[2]));
        const lanes margin = hn::MulAdd(hn::Set(d, 0x1p-18F), hn::Add(far, sizes), slack);
        const lanes apart =
            hn::Sub(hn::Sub(hn::Sub(dot(direction, gap), reach_along(cylinder, direction)),
                            reach_along(that, direction)),
                    margin);
        const lanes square = hn::Mul(hn::Mul(apart, apart), hn::Set(d, 1.0F - 0x1p-17F));
        const lanes known = hn::Load(d, squared + i);
        const auto raises = hn::And(hn::Gt(apart, hn::Zero(d)), hn::Gt(square, known));
        const lanes raised = hn::IfThenElse(raises, square, known);
        hn::Store(raised, d, squared + i);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Le(raised, hn::Set(d, bound)), bits);
        within |= (bits[0] & ((1U << width) - 1)) << i;
    }
    return within;
}

}  // namespace
}  // namespace treeform::detail::nearness::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::nearness {
namespace {

HWY_EXPORT(measure_blocks);
HWY_EXPORT(raise_eight);

cylinder_map disc_map_of(const frame_map<3>& frame) {
    cylinder_map map{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 3.0F, 1.0F};
    if (frame.identity) return map;
    map.size = 0.0F;
    float squares = 0.0F;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j) {
            map.linear[k][j] = frame.linear[k][j];
            map.size += std::abs(map.linear[k][j]);
            squares += map.linear[k][j] * map.linear[k][j];
        }
    map.square = 3.0F / squares;
    return map;
}

placed_cylinder disc_of(const bounding_cylinders& cylinders, const frame_map<3>& frame,
                        std::uint32_t level, std::uint32_t node) {
    const eight_cylinders& of = cylinders.below(level - 1, node / 8);
    const std::size_t slot = node % 8;
    placed_cylinder cylinder{};
    cylinder.half = of.half[slot];
    cylinder.radius = of.radius[slot];
    for (std::size_t k = 0; k < 3; ++k) {
        cylinder.normal[k] = of.normal[k][slot];
        cylinder.center[k] = of.center[k][slot];
    }
    if (frame.identity) return cylinder;
    for (std::size_t k = 0; k < 3; ++k) {
        float at = 0.0F;
        cylinder.slack += frame.slack_offset[k];
        for (std::size_t j = 0; j < 3; ++j) {
            at += frame.linear[k][j] * of.center[j][slot];
            cylinder.slack += frame.slack[k][j] * std::abs(of.center[j][slot]);
        }
        cylinder.center[k] = at + frame.offset[k];
    }
    return cylinder;
}

/// The sum of the normals of eight triangles, each as long as twice its area.
point3 normal_of(const eight_triangles& t, std::size_t in_use) {
    point3 sum;
    for (std::size_t i = 0; i < in_use; ++i) {
        double u[3], v[3];
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = t.at[1][k][i] - t.at[0][k][i];
            v[k] = t.at[2][k][i] - t.at[0][k][i];
        }
        sum.x += u[1] * v[2] - u[2] * v[1];
        sum.y += u[2] * v[0] - u[0] * v[2];
        sum.z += u[0] * v[1] - u[1] * v[0];
    }
    return sum;
}

/// About the middle of the node's box.
cylinder_axis axis_of(const wide_node<3>& box, std::size_t slot, const point3& normal) {
    cylinder_axis axis{};
    const double length = std::hypot(normal.x, normal.y, normal.z);
    double rounded = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        axis.center[k] =
            0.5 * (static_cast<double>(box.min[k][slot]) + static_cast<double>(box.max[k][slot]));
        const double part = length > 0.0 && std::isfinite(length) ? normal[k] / length : k == 2;
        axis.normal[k] = base::nearest_float(part);
        rounded += axis.normal[k] * axis.normal[k];
    }
    for (double& part : axis.normal) part /= std::sqrt(rounded);
    return axis;
}

/// Adds to `extent` how a cylinder of the same frame reaches.
void measure_disc(const eight_cylinders& cylinders, std::size_t slot, const cylinder_axis& axis,
                  axial_extent& extent) {
    double along = 0.0, cosine = 0.0, square = 0.0;
    double from[3];
    for (std::size_t k = 0; k < 3; ++k) {
        from[k] = static_cast<double>(cylinders.center[k][slot]) - axis.center[k];
        along += from[k] * axis.normal[k];
        cosine += static_cast<double>(cylinders.normal[k][slot]) * axis.normal[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double off = from[k] - along * axis.normal[k];
        square += off * off;
    }
    const double half = cylinders.half[slot], radius = cylinders.radius[slot];
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    // The normal of the cylinder is a little longer or shorter than 1, and the sine a root.
    const double reach = half * std::abs(cosine) + radius * sine + 0x1p-10 * radius;
    extent.least = std::min(extent.least, along - reach);
    extent.most = std::max(extent.most, along + reach);
    const double away = std::sqrt(square) + std::hypot(half, radius);
    extent.squared = std::max(extent.squared, away * away);
}

/// The center moves along the normal to the middle of the extent, and is rounded to float; the
/// cylinder grows by these roundings and those of the extent.
void put_disc(const cylinder_axis& axis, const axial_extent& extent, eight_cylinders& into,
              std::size_t slot) {
    const double middle = 0.5 * (extent.least + extent.most);
    const double half = 0.5 * (extent.most - extent.least);
    const double radius = std::sqrt(extent.squared);
    double reach = half + radius;
    for (const double center : axis.center) reach += std::abs(center);
    const bool sensible = reach < 1e18;  // false for NaN
    const double grown = 0x1p-21 * (reach + std::abs(middle)) + 1e-36;
    for (std::size_t k = 0; k < 3; ++k) {
        const double center = axis.center[k] + middle * axis.normal[k];
        into.center[k][slot] = sensible ? static_cast<float>(center) : 0.0F;
        into.normal[k][slot] = static_cast<float>(axis.normal[k]);
    }
    into.half[slot] = sensible ? float_above(half + grown) : 0.0F;
    into.radius[slot] =
        sensible ? float_above(radius + grown) : std::numeric_limits<float>::infinity();
}

}  // namespace

bounding_cylinders::bounding_cylinders(const tree<3>& tree,
                                       const buffer<eight_triangles>& triangles) {
    const unsigned last = tree.levels() - 1;
    if (last == 0) return;
    std::size_t total = 0;
    for (unsigned level = 0; level < last; ++level) {
        begin_[level] = total;
        total += tree.nodes_in_level(level);
    }
    cylinders_.resize(total);
    std::vector<point3> normals(tree.nodes_in_level(last));
    base::for_numbers(normals.size(), 512, [&](std::size_t i) {
        normals[i] = normal_of(triangles[i], tree.child_count(last, i));
    });
    // From the triangles themselves while they stay in the cache; far above, where surfaces are
    // round, from the cylinders below.
    constexpr std::size_t most_measured = 8;
    for (unsigned level = last; level-- > 0;) {
        const std::size_t nodes = tree.nodes_in_level(level);
        const std::size_t blocks_of_child = tree.capacity(level + 1) / 8;
        std::vector<point3> sums(nodes);
        const std::size_t grain = std::max<std::size_t>(1, 64 / blocks_of_child);
        base::for_numbers(nodes, grain, [&](std::size_t node) {
            eight_cylinders& cylinders = cylinders_[begin_[level] + node];
            cylinders = {};
            for (std::size_t slot = 0; slot < tree.child_count(level, node); ++slot) {
                const std::size_t child = node * 8 + slot;
                const point3& normal = normals[child];
                for (std::size_t k = 0; k < 3; ++k) sums[node][k] += normal[k];
                const cylinder_axis axis = axis_of(tree.level(level)[node], slot, normal);
                axial_extent extent;
                if (blocks_of_child <= most_measured) {
                    const std::size_t first = child * blocks_of_child;
                    const std::size_t end_block =
                        std::min(first + blocks_of_child, triangles.size());
                    HWY_DYNAMIC_DISPATCH(measure_blocks)
                    (triangles.data() + first, triangles.data() + end_block, tree.frame(), axis,
                     extent);
                } else {
                    for (std::size_t i = 0; i < tree.child_count(level + 1, child); ++i)
                        measure_disc(cylinders_[begin_[level + 1] + child], i, axis, extent);
                }
                put_disc(axis, extent, cylinders, slot);
            }
        });
        normals = std::move(sums);
    }
}

unsigned cylinder_pair::raise(const opened_node& at, unsigned mask, float bound,
                              float* squared) const {
    if (mask == 0 || at.other_level == 0) return mask;
    const frame_map<3>& frame = at.of_a ? map_a : map_b;
    const frame_map<3>& frame_of_other = at.of_a ? map_b : map_a;
    const placed_cylinder other =
        disc_of(at.of_a ? b : a, frame_of_other, at.other_level, at.other_index);
    const eight_cylinders& cylinders = (at.of_a ? a : b).below(at.level, at.index);
    return mask & HWY_DYNAMIC_DISPATCH(raise_eight)(cylinders, frame, disc_map_of(frame), other,
                                                    disc_map_of(frame_of_other), bound, squared);
}

}  // namespace treeform::detail::nearness
#endif
