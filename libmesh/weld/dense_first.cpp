#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/dense.hpp>
#include <libmesh/weld/hashed_ids.hpp>
#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/nearest_kept.hpp>
#include <libmesh/weld/reach.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace treeform::detail::weld {

std::vector<std::uint32_t> dense_leaders(points_view points, const weld_options& options) {
    constexpr std::size_t per_call = std::size_t{1} << 16;
    // Cubes twice the tolerance wide: it reaches two a side.
    const cube_axis axis(2.0 * options.tolerance);
    const double reach_in_cubes = 0.5;
    const reach within(options.tolerance);
    const auto label_of = [&](std::uint32_t i) {
        return options.label.empty() ? 0U : options.label[i];
    };
    std::vector<std::uint32_t> leader_of(points.size());
    hashed_ids kept;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (i % per_call == 0 && options.progress &&
            !options.progress(static_cast<double>(i) / static_cast<double>(points.size())))
            return {};
        leader_of[i] = i;
        const point3& p = points[i];
        if (!base::is_finite(p)) continue;
        std::array<cube_axis::range, 3> ranges;
        for (std::size_t k = 0; k < 3; ++k) ranges[k] = axis.around(p[k], reach_in_cubes);
        std::array<std::uint64_t, 27> hashes;
        std::size_t count = 0;
        for (std::int64_t x = ranges[0].first; x <= ranges[0].last; ++x)
            for (std::int64_t y = ranges[1].first; y <= ranges[1].last; ++y)
                for (std::int64_t z = ranges[2].first; z <= ranges[2].last; ++z) {
                    hashes[count] = cube_hash(x, y, z, label_of(i));
                    kept.prefetch(hashes[count++]);
                }
        nearest_kept best(p);
        const auto consider = [&](std::uint32_t other) {
            if (label_of(i) != label_of(other) || !within.holds(p, points[other])) return;
            if (!options.may_merge || options.may_merge(i, other))
                best.consider(other, points[other]);
        };
        for (std::size_t k = 0; k < count; ++k) kept.visit(hashes[k], consider);
        if (best.any())
            leader_of[i] = static_cast<std::uint32_t>(best.id());
        else
            kept.add(cube_hash(axis.index(p.x), axis.index(p.y), axis.index(p.z), label_of(i)), i);
    }
    return leader_of;
}

}  // namespace treeform::detail::weld
