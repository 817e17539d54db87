#pragma once
/// \file
/// Results in floats held against those in doubles.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/certified.hpp>
#include <support/solid_checks.hpp>

#include <cmath>

namespace test {

/// A result in floats is certified, rightly, and has the volume of the one in doubles, as far as
/// its points have moved. Where that one is not certified, its volume says nothing.
template <class Result>
void check_floats(const Result& doubles, const Result& floats) {
    CHECK(floats.certificate.status == tf::status::ok);
    CHECK(floats.certificate.precision == tf::precision::float32);
    CHECK(is_in_floats(floats.mesh));
    CHECK(is_clean_solid(floats.mesh));
    if (!doubles.certificate) return;
    const double off = std::abs(tf::signed_volume(floats.mesh) - tf::signed_volume(doubles.mesh));
    const double moved = floats.certificate.max_displacement + doubles.certificate.max_displacement;
    CHECK(off <= 2.0 * moved * (area(floats.mesh) + area(doubles.mesh)));
}

}  // namespace test
