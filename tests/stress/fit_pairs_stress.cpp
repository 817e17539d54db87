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

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

struct fit_way {
    const char* name;
    tf::align_options options;
    unsigned found = 0, seen = 0, refused = 0, mistaken = 0;
};

}  // namespace

TEST_CASE("align: of real pairs nine in ten are found, and no wrong place converges") {
    NEEDS_MODELS();
    NEEDS_CLOUDS();
    const char* folder = std::getenv("TREEFORM_PAIRS_DIR");
    const char* only = std::getenv("TREEFORM_ONLY");
    std::array<fit_way, 2> ways{
        {{"welsch", {.weights = tf::align_weights::welsch}}, {"as is", {}}}};
    std::size_t pairs = 0;
    std::printf("%-34s %7s %7s %9s  %8s %5s %s\n", "", "moving", "fixed", "", "error", "s", "end");
    test::for_fit_pairs(
        test::models_folder(), test::clouds_folder(), test::stress_count(2),
        [&](const test::fit_pair& pair) {
            CAPTURE(pair.name);
            if (only && pair.name.find(only) == std::string::npos) return;
            if (folder != nullptr) test::write_pair(folder, pairs, pair);
            ++pairs;
            for (fit_way& way : ways) {
                CAPTURE(way.name);
                const auto start = std::chrono::steady_clock::now();
                const auto found = tf::align(pair.moving, pair.fixed, way.options);
                const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
                const double error = pair.error_of(found.matrix);
                const bool right = error <= 1.0;
                way.found += right;
                way.seen += right && found.converged;
                way.refused += !right && !found.converged;
                way.mistaken += !right && found.converged;
                CHECK((right || !found.converged));
                std::printf(
                    "%-34s %7zu %7zu %-9s %8.3f%s %5.2f %s %.1e\n", pair.name.c_str(),
                    pair.moving.size(),
                    pair.fixed.faces.empty() ? pair.fixed.points.size() : pair.fixed.faces.size(),
                    way.name, error, right ? " " : "*", took.count(), tf::name_of(found.end),
                    pair.right / tf::diagonal(tf::bounding_box(pair.fixed.points).value()));
            }
        });
    std::printf("%zu pairs: found, of them converged; else refused, mistaken\n", pairs);
    for (const fit_way& way : ways)
        std::printf("%-9s %4u %4u %4u %4u\n", way.name, way.found, way.seen, way.refused,
                    way.mistaken);
    CHECK(10 * ways[0].found >= 9 * pairs);
}
