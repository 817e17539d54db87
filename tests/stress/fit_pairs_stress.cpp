/// \file
/// Real clouds and meshes fitted to each other, from 10 degrees and a tenth of the size away: nine
/// in ten are found, and no wrong place is said to be right. Without TREEFORM_MODELS_DIR and
/// TREEFORM_CLOUDS_DIR nothing is checked. TREEFORM_STRESS_COUNT is the number of pairs of each of
/// the 20 sources, up to 10 (default 2). TREEFORM_PAIRS_DIR names a folder that the pairs are
/// written to, for tests/bench/icp_beside_open3d.py.

#include "fit_pairs.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/settings.hpp>

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace {

/// Of pairs.
struct fit_counts {
    unsigned found = 0;      ///< within what is right
    unsigned converged = 0;  ///< and said to be
    unsigned refused = 0;    ///< elsewhere, and not said to be right
    unsigned mistaken = 0;   ///< elsewhere, and said to be
};

void add(fit_counts& all, const test::fit_pair& pair) {
    const auto found = tf::align(pair.moving, pair.fixed);
    const double error = pair.error_of(found.matrix);
    const bool right = error <= 1.0;
    all.found += right ? 1 : 0;
    all.converged += right && found.converged ? 1 : 0;
    all.refused += right || found.converged ? 0 : 1;
    all.mistaken += !right && found.converged ? 1 : 0;
    CHECK((right || !found.converged));
    std::printf("%-32s %7zu %7zu  %7.3f%s %s\n", pair.name.c_str(), pair.moving.size(),
                pair.fixed.faces.empty() ? pair.fixed.points.size() : pair.fixed.faces.size(),
                error, right ? " " : "*", tf::name_of(found.outcome));
}

}  // namespace

TEST_CASE("align: of real pairs nine in ten are found, and no wrong place converges") {
    NEEDS_MODELS();
    NEEDS_CLOUDS();
    const char* folder = std::getenv("TREEFORM_PAIRS_DIR");
    fit_counts all;
    std::size_t pairs = 0;
    std::printf("%-32s  moving   fixed    error; 1 is right\n", "");
    test::for_fit_pairs(test::models_folder(), test::clouds_folder(), test::stress_count(2),
                        [&](const test::fit_pair& pair) {
                            CAPTURE(pair.name);
                            if (folder != nullptr) test::write_pair(folder, pairs, pair);
                            ++pairs;
                            add(all, pair);
                        });
    std::printf("of %zu: found %u, of these converged %u; refused %u, mistaken %u\n", pairs,
                all.found, all.converged, all.refused, all.mistaken);
    CHECK(10 * all.found >= 9 * pairs);
}
