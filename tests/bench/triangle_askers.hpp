#pragma once
/// \file
/// Ways to ask of pairs of triangles whether they meet, as E1 and E9 compare them.

#include "bench/peers/cgal_predicates.hpp"
#include "bench/peers/sign_triangles.hpp"
#include "support/stress_families.hpp"
#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cstddef>
#include <functional>
#include <span>

namespace treeform::bench {

using pairs_view = std::span<const test::triangle_pair>;
/// What asks all of the pairs at once.
using make_asker = std::function<asker(pairs_view)>;

/// Neither triangle is a segment or a point; some peers take no such.
[[nodiscard]] inline bool is_proper(const test::triangle_pair& pair) {
    const auto proper = [](const triangle3& t) { return !collinear(t[0], t[1], t[2]); };
    return proper(pair.a) && proper(pair.b);
}

template <class Meet>
[[nodiscard]] make_asker asking_each(Meet meet) {
    return [meet](pairs_view pairs) {
        return [pairs, meet](verdicts& found) {
            for (std::size_t i = 0; i < pairs.size(); ++i)
                found[i] = meet(pairs[i].a, pairs[i].b) ? 1 : 0;
        };
    };
}

[[nodiscard]] inline make_asker asking_treeform() {
    return asking_each(
        [](const triangle3& a, const triangle3& b) { return intersect(a, b).count != 0; });
}

/// The one test whose signs come from `Signs`.
template <class Signs>
[[nodiscard]] make_asker asking_signs(double eps = 0.0) {
    return asking_each(
        [eps](const triangle3& a, const triangle3& b) { return triangles_meet<Signs>(a, b, eps); });
}

[[nodiscard]] inline make_asker asking_cgal_filtered() {
    return [](pairs_view pairs) { return cgal_filtered(question::triangles_meet, pairs); };
}

}  // namespace treeform::bench
