/// \file
/// Every predicate against GMP's integers, on groups of points of every family.
///
/// TREEFORM_STRESS_COUNT sets the calls of each predicate in each family (default 100,000):
///     TREEFORM_STRESS_COUNT=10000000 ctest --test-dir build/release -R exact_oracle -V

#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/gmp_predicates.hpp>
#include <support/point_families.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

long predicate_calls() { return std::max(1L, static_cast<long>(test::stress_count(100000))); }

struct predicate_tally {
    long zeros = 0;
    long wrong = 0;
    tf::predicate_counters counters;
};

predicate_tally run_predicate(const tf::test::gmp_predicate& predicate,
                              tf::test::point_family family, long calls) {
    tf::test::point_stream stream(family, 1 + static_cast<std::uint64_t>(family));
    predicate_tally result;
    for (long i = 0; i < calls; ++i) {
        const std::vector<tf::point3> points = stream.next(predicate.points);
        const int truth = predicate.truth(tf::test::whole(points));
        result.zeros += truth == 0;
        result.wrong += predicate.ours(points, &result.counters) != (truth > 0) - (truth < 0);
    }
    return result;
}

TEST_CASE("every predicate has the sign that GMP's integers have") {
    const long calls = predicate_calls();
    std::printf("%-18s %-12s %10s %7s %9s %6s  %s\n", "predicate", "family", "calls", "zero %",
                "open %", "wrong", "decided at width 0..6");
    for (const tf::test::gmp_predicate& predicate : tf::test::gmp_predicates) {
        for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
            const std::string family(tf::test::point_family_names[f]);
            const predicate_tally t =
                run_predicate(predicate, static_cast<tf::test::point_family>(f), calls);
            const auto percent = [&](auto n) {
                return 100.0 * static_cast<double>(n) / static_cast<double>(calls);
            };
            std::printf("%-18s %-12s %10ld %7.2f %9.3f %6ld ", predicate.name, family.c_str(),
                        calls, percent(t.zeros), percent(t.counters.undecided), t.wrong);
            for (const std::uint64_t n : t.counters.by_width)
                std::printf(" %llu", static_cast<unsigned long long>(n));
            std::printf("\n");
            CAPTURE(predicate.name);
            CAPTURE(family);
            CHECK(t.wrong == 0);
            CHECK(t.counters.calls == static_cast<std::uint64_t>(calls));
        }
    }
}

}  // namespace
