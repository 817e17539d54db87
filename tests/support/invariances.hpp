#pragma once
/// \file
/// What must not change the pairs that intersect.

#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace test {

/// The pairs of `mesh` in the numbers of another mesh.
inline std::vector<tf::face_pair> renamed_pairs(const shuffled_mesh& other) {
    std::vector<tf::face_pair> pairs =
        tf::self_intersections(other.mesh, {.vertices = tf::vertex_identity::by_index}).pairs;
    for (tf::face_pair& pair : pairs) {
        const std::uint32_t a = other.old_of_new[pair.a];
        const std::uint32_t b = other.old_of_new[pair.b];
        pair.a = std::min(a, b);
        pair.b = std::max(a, b);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// Coordinates exchanged: x, y, z become the coordinates numbered by `axes`.
inline tf::mesh with_axes(tf::mesh mesh, const std::array<std::size_t, 3>& axes) {
    for (tf::point3& p : mesh.points) p = {p[axes[0]], p[axes[1]], p[axes[2]]};
    return mesh;
}

/// Names of the changes after which the pairs, or their kinds, are others than before; empty as
/// it should be. Scaling is left out where it would round.
inline std::vector<std::string> changes_that_matter(random& source, const tf::mesh& mesh) {
    std::vector<std::string> found;
    const std::vector<tf::face_pair> pairs =
        tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).pairs;
    const auto compare = [&](const std::string& change, const std::vector<tf::face_pair>& now) {
        if (now != pairs) found.push_back(change);
    };
    compare("order of points, faces and corners", renamed_pairs(shuffled(source, mesh)));
    compare("axes turned", tf::self_intersections(with_axes(mesh, {1, 2, 0}),
                                                  {.vertices = tf::vertex_identity::by_index})
                               .pairs);
    compare("axes exchanged", tf::self_intersections(with_axes(mesh, {0, 2, 1}),
                                                     {.vertices = tf::vertex_identity::by_index})
                                  .pairs);
    for (const double factor : {0x1p-100, 0x1p+100, 0x1p-700, 0x1p+600}) {
        const tf::mesh other = scaled(mesh, factor);
        if (scaled(other, 1.0 / factor) == mesh)
            compare(
                "scale " + std::to_string(factor),
                tf::self_intersections(other, {.vertices = tf::vertex_identity::by_index}).pairs);
    }
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        compare(std::to_string(threads) + " threads",
                tf::self_intersections(mesh, {.vertices = tf::vertex_identity::by_index}).pairs);
    }
    return found;
}

}  // namespace test
