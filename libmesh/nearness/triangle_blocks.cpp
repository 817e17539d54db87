#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/nearness/triangle_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::nearness::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using lanes_tag = hn::CappedTag<double, 8>;
using vec = hn::Vec<lanes_tag>;

void move_eight(const eight_triangles& from, const transform<3>& by, double unit,
                eight_triangles& to) {
    const lanes_tag d;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d))
        for (std::size_t corner = 0; corner < 3; ++corner) {
            // All read before anything is written: `to` may be `from`.
            const vec x = hn::Load(d, from.at[corner][0] + i);
            const vec y = hn::Load(d, from.at[corner][1] + i);
            const vec z = hn::Load(d, from.at[corner][2] + i);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto factor = [&](std::size_t j) { return hn::Set(d, by.rows[k][j]); };
                const vec sum = hn::Add(hn::Add(hn::Mul(factor(0), x), hn::Mul(factor(1), y)),
                                        hn::Mul(factor(2), z));
                const vec moved = hn::Add(sum, factor(3));
                hn::Store(hn::Mul(moved, hn::Set(d, unit)), d, to.at[corner][k] + i);
            }
        }
}

/// How far eight triangles reach along a line, and, at most, from its origin.
struct spans {
    alignas(64) double least[8], most[8], reach[8];
};

HWY_INLINE void look_along(const eight_triangles& t, const sight_line& line, spans& seen) {
    const lanes_tag d;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
        vec least = hn::Zero(d), most = least, reach = least;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto from_origin = [&](std::size_t k) {
                return hn::Sub(hn::Load(d, t.at[corner][k] + i), hn::Set(d, line.origin[k]));
            };
            const vec x = from_origin(0), y = from_origin(1), z = from_origin(2);
            const vec along = hn::Add(hn::Add(hn::Mul(x, hn::Set(d, line.direction.x)),
                                              hn::Mul(y, hn::Set(d, line.direction.y))),
                                      hn::Mul(z, hn::Set(d, line.direction.z)));
            const vec far = hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z));
            least = corner == 0 ? along : hn::Min(least, along);
            most = corner == 0 ? along : hn::Max(most, along);
            reach = corner == 0 ? far : hn::Add(reach, far);
        }
        hn::Store(least, d, seen.least + i);
        hn::Store(most, d, seen.most + i);
        hn::Store(reach, d, seen.reach + i);
    }
}

/// The length of the direction and the square root that `distance` is are right to 2^-49; a
/// difference from the origin, its product with the direction and the sums are off by less than
/// 2^-50 in proportion to `reach`. NaN, from sums that overflow, drops nothing.
void drop_eight(const eight_triangles& a, const eight_triangles& b, const sight_line& line,
                double distance, slot_pairs& pairs) {
    const lanes_tag d;
    const std::size_t lanes = hn::Lanes(d);
    spans of_a, of_b;
    look_along(a, line, of_a);
    look_along(b, line, of_b);
    const vec unsure = hn::Set(d, 0x1p-45);
    for (std::size_t i = 0; i < 8; ++i) {
        if (pairs[i] == 0) continue;
        const vec enough = hn::Set(d, distance * (1.0 + 0x1p-40) + 0x1p-45 * of_a.reach[i]);
        const vec ahead_of = hn::Set(d, of_a.most[i]);
        for (std::size_t j = 0; j < 8; j += lanes) {
            const vec gap = hn::Sub(hn::Load(d, of_b.least + j), ahead_of);
            const vec least = hn::Add(enough, hn::Mul(unsure, hn::Load(d, of_b.reach + j)));
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, hn::Gt(gap, least), bits);
            pairs[i] &= ~((bits[0] & ((1U << lanes) - 1)) << j);
        }
    }
}

}  // namespace
}  // namespace treeform::detail::nearness::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::nearness {
namespace {

HWY_EXPORT(move_eight);
HWY_EXPORT(drop_eight);

}  // namespace

buffer<eight_triangles> triangle_blocks(mesh_view mesh, const tree<3>& tree) {
    const std::size_t blocks = chunk_count(tree.size(), 8);
    buffer<eight_triangles> result;
    result.resize(blocks);
    for_chunks(blocks, 512, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t place = begin * 8; place < end * 8; ++place) {
            const std::size_t taken = place < tree.size() ? place : place / 8 * 8;
            const face& f = mesh.faces[tree.ids()[taken]];
            result.data()[place / 8].set(place % 8,
                                         {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]});
        }
    });
    return result;
}

void move_triangles(const eight_triangles& from, const transform<3>& by, double unit,
                    eight_triangles& to) {
    HWY_DYNAMIC_DISPATCH(move_eight)(from, by, unit, to);
}

void drop_separated(const eight_triangles& a, const eight_triangles& b, const sight_line& line,
                    double distance, slot_pairs& pairs) {
    HWY_DYNAMIC_DISPATCH(drop_eight)(a, b, line, distance, pairs);
}

}  // namespace treeform::detail::nearness
#endif
