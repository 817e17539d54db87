/// \file
/// Scans of real solids aligned to them: the right place is found and said to be, a wrong one never
/// is. Without TREEFORM_MODELS_DIR nothing is checked. TREEFORM_STRESS_COUNT is the number of scans
/// of each kind (default 1).

#include <treeform/mesh/align.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/scans.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

/// What is scanned, and what the alignment is told.
struct way {
    std::string name;
    test::scanned what;
    tf::align_options options;
};

const std::array<way, 7> ways{
    {{"all", test::scanned::all, {}},
     {"all, starts", test::scanned::all, {.starts = 40}},
     {"part of fixed, overlap", test::scanned::part_of_fixed, {.overlap = 0.6}},
     {"part of fixed", test::scanned::part_of_fixed, {}},
     {"part of fixed, equal", test::scanned::part_of_fixed, {.robust = false}},
     {"part of moving", test::scanned::part_of_moving, {}},
     {"part of moving, equal", test::scanned::part_of_moving, {.robust = false}}}};

/// Of scans of one kind.
struct verdicts {
    unsigned right = 0;     ///< within the noise, and status 0
    unsigned unseen = 0;    ///< within the noise, but not status 0
    unsigned between = 0;   ///< up to three times the noise
    unsigned refused = 0;   ///< elsewhere, and not status 0
    unsigned mistaken = 0;  ///< elsewhere, and status 0

    void add(double error, double noise, double exact, bool converged) {
        if (error <= noise)
            ++(converged ? right : unseen);
        else if (error <= 3.0 * std::max(noise, exact))
            ++between;
        else
            ++(converged ? mistaken : refused);
    }
};

void print(const char* name, const verdicts& v) {
    std::printf("%-24s %6u %6u %8u %8u %8u\n", name, v.right, v.unseen, v.between, v.refused,
                v.mistaken);
}

}  // namespace

TEST_CASE("align: of scans of real solids, right places converge and wrong ones never do") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    std::array<verdicts, ways.size()> sums;
    for (const std::string& file : test::files_with_truth(folder)) {
        if (!file.starts_with("clean/")) continue;
        CAPTURE(file);
        const tf::mesh solid = tf::as_mesh(tf::read(folder / file)).mesh;
        // It is itself when it is turned by a side, to the seven digits that are in the file.
        const bool symmetric = file.find("torus") != std::string::npos;
        const double exact = symmetric ? 1e-6 : 1e-9;
        std::uint64_t seed = test::stress_seed();
        for (std::size_t w = 0; w < ways.size(); ++w)
            for (const double noise : {0.0, 1e-5, 1e-4, 1e-3})
                for (const double degrees : {3.0, 10.0, 20.0, 45.0}) {
                    const bool is_slow = !ways[w].options.robust && degrees != 10.0;
                    // What is in doubt by equal weights takes long to be judged.
                    for (std::uint64_t i = 0; i < test::stress_count(1) && !is_slow; ++i) {
                        CAPTURE(ways[w].name);
                        CAPTURE(noise);
                        CAPTURE(degrees);
                        CAPTURE(seed);
                        test::random source(seed++);
                        const bool all = ways[w].what == test::scanned::all;
                        const test::scan scan = test::scan_of(solid,
                                                              {.points = 2000,
                                                               .noise = noise,
                                                               .degrees = degrees,
                                                               .share = all ? 1.0 : 0.6,
                                                               .what = ways[w].what},
                                                              source);
                        const auto found = tf::align(scan.moving, scan.fixed, ways[w].options);
                        verdicts one;
                        one.add(test::error_of(scan, found.matrix, symmetric),
                                std::max(noise, 1e-9), exact, found.converged);
                        CHECK(one.unseen == 0);
                        CHECK(one.mistaken == 0);
                        sums[w].right += one.right;
                        sums[w].unseen += one.unseen;
                        sums[w].between += one.between;
                        sums[w].refused += one.refused;
                        sums[w].mistaken += one.mistaken;
                    }
                }
    }
    std::printf("%-24s  right unseen  between  refused mistaken\n", "");
    for (std::size_t w = 0; w < ways.size(); ++w) print(ways[w].name.c_str(), sums[w]);
}
