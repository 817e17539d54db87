#include "bench/peers/fcl_sweep.hpp"

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace treeform::bench {

std::optional<double> fcl_first_contact(const triangle3& a, const triangle3& b, const point3& d) {
    using vector = fcl::Vector3d;
    using kernel = fcl::detail::Intersect<double>;
    std::array<vector, 3> from, to, still;
    for (std::size_t i = 0; i < 3; ++i) {
        from[i] = {a[i].x, a[i].y, a[i].z};
        to[i] = {a[i].x + d.x, a[i].y + d.y, a[i].z + d.z};
        still[i] = {b[i].x, b[i].y, b[i].z};
    }
    std::optional<double> first;
    const auto offer = [&](bool met, double time) {
        if (met && (!first || time < *first)) first = time;
    };
    vector where;
    for (std::size_t i = 0; i < 3; ++i) {
        double time = 0;
        bool met = kernel::intersect_VF(still[0], still[1], still[2], from[i], still[0], still[1],
                                        still[2], to[i], &time, &where);
        offer(met, time);
        met = kernel::intersect_VF(from[0], from[1], from[2], still[i], to[0], to[1], to[2],
                                   still[i], &time, &where);
        offer(met, time);
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t k = (i + 1) % 3, l = (j + 1) % 3;
            met = kernel::intersect_EE(from[i], from[k], still[j], still[l], to[i], to[k], still[j],
                                       still[l], &time, &where);
            offer(met, time);
        }
    }
    return first;
}

}  // namespace treeform::bench
