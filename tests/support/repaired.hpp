#pragma once
/// \file
/// What a repaired mesh has to be.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <utility>

namespace test {

inline tf::mesh two_balls() { return together(ball(3, 1.0), moved(ball(3, 1.0), {0.7, 0.3, 0.1})); }

inline void turn(tf::face& f) { std::swap(f[1], f[2]); }

/// As programs see it that join equal coordinates.
inline bool is_manifold_in_coordinates(const tf::mesh& mesh) {
    const tf::mesh joined = tf::weld(mesh).mesh;
    const auto counts = tf::count_topology(joined.points.size(), joined.faces);
    return counts.closed_manifold && counts.misoriented_edges == 0 &&
           counts.nonmanifold_points == 0;
}

inline void require_solid(const tf::repair_result& result, double volume) {
    REQUIRE_MESSAGE(result.certificate, result.certificate.message());
    CHECK(is_manifold_in_coordinates(result.mesh));
    CHECK(tf::self_intersections(result.mesh).pairs.empty());
    CHECK(tf::signed_volume(result.mesh) == doctest::Approx(volume));
    CHECK(result.face_source.size() == result.mesh.faces.size());
    CHECK(result.vertex_source.size() == result.mesh.points.size());
}

}  // namespace test
