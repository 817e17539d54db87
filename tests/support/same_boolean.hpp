#pragma once
/// \file
/// Whether two results of a set operation are one.

#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>

#include <algorithm>
#include <vector>

namespace test {

/// Its faces in an order of their own, each from its lowest corner on.
inline std::vector<tf::face> sorted_faces(std::vector<tf::face> faces) {
    for (tf::face& f : faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    std::sort(faces.begin(), faces.end());
    return faces;
}

/// All but what was left out as hidden. Where it was, faces may be in another order.
inline void check_same_boolean(const tf::boolean_result& result,
                               const tf::boolean_result& general) {
    CHECK(result.certificate);
    const auto pairs = result.statistics.pairs, of_all = general.statistics.pairs;
    CHECK(pairs <= of_all);
    CHECK(result.mesh.points == general.mesh.points);
    if (pairs == of_all)
        CHECK(result.mesh.faces == general.mesh.faces);
    else
        CHECK(sorted_faces(result.mesh.faces) == sorted_faces(general.mesh.faces));
    CHECK(result.face_source == general.face_source);
    CHECK(result.vertex_source == general.vertex_source);
    CHECK(result.certificate.max_displacement == general.certificate.max_displacement);
    if (pairs == of_all) CHECK(result.statistics.cut_faces == general.statistics.cut_faces);
    CHECK(result.statistics.exact_faces == general.statistics.exact_faces);
    CHECK(is_clean_solid(result.mesh));
}

}  // namespace test
