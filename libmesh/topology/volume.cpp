#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/double_double.hpp>
#include <libmesh/topology/volume.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/topology/volume.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TREEFORM_TOPOLOGY_VOLUME_BLOCK
#define TREEFORM_TOPOLOGY_VOLUME_BLOCK
namespace treeform::detail::topology {
namespace {

constexpr std::size_t volume_lanes = 8;  // so many sums, on any machine

using lane_sums = std::array<base::double_double, volume_lanes>;

}  // namespace
}  // namespace treeform::detail::topology
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::topology::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using lanes_tag = hn::CappedTag<double, volume_lanes>;

using vec = hn::Vec<lanes_tag>;

/// As `base::double_double`, side by side: functions for one kind of machine cannot use those
/// there.
struct doubled {
    vec high, low;
};

HWY_INLINE doubled sum_of(const vec& a, const vec& b) {
    const vec sum = hn::Add(a, b);
    const vec b_there = hn::Sub(sum, a);
    return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, b_there)), hn::Sub(b, b_there))};
}

HWY_INLINE doubled sum_of_ordered(const vec& a, const vec& b) {
    const vec sum = hn::Add(a, b);
    return {sum, hn::Sub(b, hn::Sub(sum, a))};
}

#if HWY_NATIVE_FMA
HWY_INLINE doubled product_of(const vec& a, const vec& b) {
    const vec product = hn::Mul(a, b);
    return {product, hn::MulSub(a, b, product)};
}
#else
HWY_INLINE doubled halves_of(const vec& a) {
    const vec large = hn::Mul(hn::Set(lanes_tag(), 134217729.0), a);
    const vec high = hn::Sub(large, hn::Sub(large, a));
    return {high, hn::Sub(a, high)};
}

HWY_INLINE doubled product_of(const vec& a, const vec& b) {
    const vec product = hn::Mul(a, b);
    const doubled x = halves_of(a), y = halves_of(b);
    const vec rest =
        hn::Sub(hn::Sub(hn::Sub(product, hn::Mul(x.high, y.high)), hn::Mul(x.low, y.high)),
                hn::Mul(x.high, y.low));
    return {product, hn::Sub(hn::Mul(x.low, y.low), rest)};
}
#endif

HWY_INLINE doubled plus(const doubled& a, const doubled& b) {
    const doubled high = sum_of(a.high, b.high);
    const doubled low = sum_of(a.low, b.low);
    const doubled both = sum_of_ordered(high.high, hn::Add(high.low, low.high));
    return sum_of_ordered(both.high, hn::Add(both.low, low.low));
}

HWY_INLINE doubled times(const vec& a, const doubled& b) {
    const doubled high = product_of(a, b.high);
    return sum_of_ordered(high.high, hn::Add(high.low, hn::Mul(a, b.low)));
}

/// Six times the volumes between the origin and faces with these corners.
HWY_INLINE doubled six_volumes(const std::array<std::array<vec, 3>, 3>& corners) {
    const auto& a = corners[0];
    const auto& b = corners[1];
    const auto& c = corners[2];
    const auto minor = [&](std::size_t i, std::size_t j) HWY_ATTR {
        return plus(product_of(b[i], c[j]), product_of(hn::Neg(b[j]), c[i]));
    };
    return plus(times(a[0], minor(1, 2)), plus(times(a[1], minor(2, 0)), times(a[2], minor(0, 1))));
}

/// The sums of six times the volumes between the origin and faces.
void add_volumes(mesh_view mesh, lane_sums& sums) {
    constexpr lanes_tag d;
    const std::size_t width = hn::Lanes(d);
    alignas(64) std::array<double, volume_lanes> high{}, low{};
    alignas(64) double at[3][3][volume_lanes];
    for (std::size_t first = 0; first < mesh.faces.size(); first += volume_lanes) {
        const std::size_t count = std::min(volume_lanes, mesh.faces.size() - first);
        if (count < volume_lanes) std::fill_n(&at[0][0][0], 9 * volume_lanes, 0.0);
        for (std::size_t lane = 0; lane < count; ++lane)
            for (std::size_t i = 0; i < 3; ++i) {
                const point3& p = mesh.points[mesh.faces[first + lane][i]];
                for (std::size_t k = 0; k < 3; ++k) at[i][k][lane] = p[k];
            }
        for (std::size_t lane = 0; lane < volume_lanes; lane += width) {
            std::array<std::array<vec, 3>, 3> corners;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k) corners[i][k] = hn::Load(d, at[i][k] + lane);
            const doubled so_far{hn::Load(d, &high[lane]), hn::Load(d, &low[lane])};
            const doubled sum = plus(so_far, six_volumes(corners));
            hn::Store(sum.high, d, &high[lane]);
            hn::Store(sum.low, d, &low[lane]);
        }
    }
    for (std::size_t lane = 0; lane < volume_lanes; ++lane) sums[lane] = {high[lane], low[lane]};
}

}  // namespace
}  // namespace treeform::detail::topology::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform {
namespace detail::topology {
namespace {

HWY_EXPORT(add_volumes);

}  // namespace

base::double_double six_volumes(mesh_view surface) {
    lane_sums sums{};
    HWY_DYNAMIC_DISPATCH(add_volumes)(surface, sums);
    base::double_double all;
    for (const base::double_double& lane : sums) all = all + lane;
    return all;
}

}  // namespace detail::topology

double signed_volume(const mesh_ref& given) {
    const mesh_view mesh = given.view();
    using detail::base::double_double;
    using namespace detail::topology;
    detail::base::check_faces("signed_volume", mesh.points.size(), mesh.faces);
    std::vector<double_double> parts(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   parts[c] = six_volumes({mesh.points, mesh.faces.subspan(begin, end - begin)});
               });
    double_double all;
    for (const double_double& part : parts) all = all + part;
    return all.high / 6.0;
}

}  // namespace treeform
#endif
