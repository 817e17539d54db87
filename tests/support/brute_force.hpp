#pragma once
/// \file
/// Self-intersections by looking at every pair of faces: the words of `tf::self_intersections` as
/// two nested loops.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <support/reference_intersection.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace test {

/// What two triangles have in common, as far as the kind of a pair depends on it.
struct common_set {
    bool crossing;
    bool degenerate;                       ///< one of the two is a segment or a point
    std::vector<tf::feature_pair> ends{};  ///< of a point, a segment or an area
};

/// By the library's own triangle-triangle intersection: any finite coordinates.
inline common_set common_by_library(const tf::triangle3& a, const tf::triangle3& b) {
    const tf::triangle_contact c = tf::intersect(a, b);
    return {c.crossing,
            tf::collinear(a[0], a[1], a[2]) || tf::collinear(b[0], b[1], b[2]),
            {c.ends.begin(), c.ends.begin() + c.count}};
}

/// By cutting with half-spaces: integer coordinates up to 4 or so. Shares no code with the library.
inline common_set common_by_reference(const tf::triangle3& a, const tf::triangle3& b) {
    using reference = tf::test::reference_intersection<std::int64_t>;
    const auto whole = [](const tf::triangle3& t) {
        reference::triangle corners;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corners[i][axis] = static_cast<std::int64_t>(t[i][axis]);
        return corners;
    };
    const reference r(whole(a), whole(b));
    const auto& answer = r.answer();
    return {answer.crossing, answer.degenerate, answer.ends};
}

/// Whether a common point lies off the shared corners and off the edge between two of them.
inline bool reaches_beyond(const common_set& common, const tf::triangle3& a,
                           const std::vector<tf::point3>& shared) {
    if (common.ends.empty()) return false;
    if (shared.empty() || shared.size() == 3) return true;
    if (shared.size() == 1) return common.ends.size() > 1;
    if (common.ends.size() > 2) return true;
    return std::any_of(common.ends.begin(), common.ends.end(), [&](const tf::feature_pair& end) {
        const auto corner = static_cast<std::size_t>(end.on_a);
        return corner > 2 || (a[corner] != shared[0] && a[corner] != shared[1]);
    });
}

inline tf::pair_kind kind_of(const common_set& common, std::size_t shared) {
    if (common.degenerate) return tf::pair_kind::degenerate;
    if (shared == 3) return tf::pair_kind::duplicate;
    if (common.ends.size() > 2) return shared == 2 ? tf::pair_kind::fold : tf::pair_kind::overlap;
    if (!common.crossing) return tf::pair_kind::touching;
    return shared == 1 ? tf::pair_kind::pierce : tf::pair_kind::crossing;
}

/// Every pair with its kind, ascending. `common(a, b)` is one of the functions above.
template <class Common>
std::vector<tf::face_pair> pairs_by_brute_force(tf::mesh_view mesh, const Common& common) {
    const auto triangle = [&](const tf::face& f) {
        return tf::triangle3{mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
    };
    std::vector<tf::face_pair> pairs;
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        const std::set<std::uint32_t> corners(mesh.faces[i].begin(), mesh.faces[i].end());
        for (std::uint32_t j = i + 1; j < mesh.faces.size(); ++j) {
            std::set<std::uint32_t> ids;
            for (const std::uint32_t corner : mesh.faces[j])
                if (corners.contains(corner)) ids.insert(corner);
            std::vector<tf::point3> shared;
            for (const std::uint32_t id : ids) shared.push_back(mesh.points[id]);
            const tf::triangle3 a = triangle(mesh.faces[i]);
            const common_set both = common(a, triangle(mesh.faces[j]));
            if (reaches_beyond(both, a, shared))
                pairs.push_back({i, j, kind_of(both, shared.size())});
        }
    }
    return pairs;
}

}  // namespace test
