/// \file
/// Distances of two meshes in random poses, far, near and meeting, against all pairs of faces.
///
/// TREEFORM_STRESS_COUNT sets the poses (default 3000).

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>
#include <support/settings.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

namespace {

std::size_t poses() { return test::stress_count(3000); }

tf::triangle3 triangle_of(const tf::mesh& mesh, const tf::face& f) {
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

double by_all_pairs(const tf::mesh& a, const tf::mesh& b) {
    double least = std::numeric_limits<double>::infinity();
    for (const tf::face& f : a.faces)
        for (const tf::face& g : b.faces)
            least = std::min(
                least, tf::closest_pair(triangle_of(a, f), triangle_of(b, g)).squared_distance);
    return std::sqrt(least);
}

/// A turn about a random axis, then a move.
tf::transform<3> random_pose(test::random& source, double reach) {
    double q[4];
    double size = 0.0;
    for (double& x : q) {
        x = source.in(-1, 1);
        size += x * x;
    }
    for (double& x : q) x /= std::sqrt(size);
    const auto [w, x, y, z] = q;
    tf::transform<3> map;
    map.rows = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                  source.in(-reach, reach)},
                 {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                  source.in(-reach, reach)},
                 {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
                  source.in(-reach, reach)}}};
    return map;
}

}  // namespace

TEST_CASE("no pose has another distance than all pairs of faces give") {
    test::random source(17);
    tf::mesh a = test::ball(2, 1.0);
    for (tf::point3& p : a.points) {  // not convex
        const double bump = 1.0 + 0.3 * std::sin(5.0 * p.x) * std::cos(7.0 * p.y);
        p = {bump * p.x, bump * p.y, 0.5 * bump * p.z};
    }
    const tf::mesh b = test::box(0.5, 1.5, 0.25);
    const tf::tree<3> tree_a = tf::build_face_tree(a), tree_b = tf::build_face_tree(b);
    const tf::prepared_mesh model_a = tf::prepared_mesh::borrow(a),
                            model_b = tf::prepared_mesh::borrow(b);
    std::size_t meeting = 0;
    for (std::size_t i = 0; i < poses(); ++i) {
        CAPTURE(i);
        const tf::transform<3> pose = random_pose(source, i % 3 == 0 ? 4.0 : 1.2);
        tf::mesh moved = b;
        for (tf::point3& p : moved.points) p = pose(p);
        const double truth = by_all_pairs(a, moved);
        meeting += truth == 0.0;
        const double most = 1e-14;  // 16 u times the largest distance of corners
        const auto by_trees =
            tf::detail::nearness::closest_pair(a, tree_a, b, tf::transformed<3>(tree_b, pose));
        const auto by_models = tf::closest_pair(model_a, model_b, {.transform_b = pose});
        const auto other_way = tf::closest_pair(model_b, model_a, {.transform_a = pose});
        const auto measured = tf::measure(a, moved);
        for (const double found : {by_trees->distance, by_models->distance, other_way->distance,
                                   measured->surface_distance}) {
            CHECK((found == 0.0) == (truth == 0.0));
            CHECK(std::abs(found - truth) <= most);
        }
        const tf::point3 &p = by_models->on_a, &q = by_models->on_b;
        CHECK(std::abs(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) - truth) <= most);
    }
    CHECK(meeting > 0);
    CHECK(meeting < poses());
}
