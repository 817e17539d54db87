#pragma once
/// \file
/// Whether two results of a set operation are one.

#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solid_checks.hpp>

namespace test {

/// All but what was left out as hidden.
inline void check_same_boolean(const tf::boolean_result& result,
                               const tf::boolean_result& general) {
    CHECK(result.certificate);
    CHECK(result.mesh == general.mesh);
    CHECK(result.face_source == general.face_source);
    CHECK(result.vertex_source == general.vertex_source);
    CHECK(result.certificate.max_displacement == general.certificate.max_displacement);
    if (result.statistics.skipped_faces == 0) {
        CHECK(result.statistics.pairs == general.statistics.pairs);
        CHECK(result.statistics.cut_faces == general.statistics.cut_faces);
    }
    CHECK(result.statistics.exact_faces == general.statistics.exact_faces);
    CHECK(is_clean_solid(result.mesh));
}

}  // namespace test
