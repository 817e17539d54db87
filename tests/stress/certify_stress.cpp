/// \file
/// Whether what set operations write can be certified, in doubles and in floats: families of hard
/// cases, each result looked at again from outside, its volume against that before rounding.
///
/// TREEFORM_STRESS_COUNT sets the cases of each family (default 6), TREEFORM_STRESS_SEED the seed.

#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/certified.hpp>
#include <support/rational_volume.hpp>
#include <support/settings.hpp>
#include <support/solid_checks.hpp>
#include <support/solid_families.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

std::size_t cases_of_family() { return test::stress_count(6); }
std::uint64_t certify_seed() { return test::stress_seed(); }

double area_of(const std::vector<tf::mesh>& operands) {
    double sum = 0.0;
    for (const tf::mesh& mesh : operands) sum += test::area(mesh);
    return sum;
}

/// A result that is said to be good is; one that is not says where, and is right about it.
void look_at(const tf::boolean_result& result, bool to_float) {
    CHECK(result.certificate.open_count == 0);
    if (result.certificate) {
        CHECK(result.certificate.meeting_count == 0);
        CHECK(test::is_clean_solid(result.mesh));
        CHECK((!to_float || test::is_in_floats(result.mesh)));
    } else {
        CHECK(result.certificate.meeting_count == test::count_meeting(result.mesh));
    }
}

/// Each point has moved by max_move at most, in each coordinate; the faces that moved are some of
/// the operands', or of those that are left.
void compare_volume(const tf::boolean_result& result, const mpf_class& volume, double area) {
    const mpf_class got(test::volume_of(result.mesh), 1024);
    const double off = std::abs(mpf_class(volume - got).get_d());
    const double most =
        2.0 * result.certificate.max_displacement * (area + test::area(result.mesh));
    double reach = 0.0;
    for (const tf::point3& p : result.mesh.points)
        reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    // Sums of products of three coordinates, in 1024 bits.
    CHECK(off <= most + 1e-250 * reach * reach * reach + 1e-300);
}

void check_case(const test::solid_case& made, const std::string& name,
                test::certified_tally& tally) {
    const std::vector<tf::mesh_view> views(made.operands.begin(), made.operands.end());
    const test::exact_arrangement arranged(made.operands);
    REQUIRE(arranged.closed());
    const auto volumes = test::exact_volumes(arranged, made.asked);
    const double area = area_of(made.operands);
    for (std::size_t k = 0; k < made.asked.size(); ++k) {
        bool in_doubles = false;
        for (const bool to_float : {false, true}) {
            const std::string what =
                name + " question " + std::to_string(k) + (to_float ? " in floats" : " in doubles");
            CAPTURE(what);
            const auto result = tf::boolean(
                views, made.asked[k],
                {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
            // Beyond the range of float there is nothing to be written.
            const bool too_large = to_float && !std::isfinite(result.certificate.max_displacement);
            if (too_large) continue;
            look_at(result, to_float);
            if (result.certificate) compare_volume(result, volumes[k], area);
            const bool certified = test::is_certified(result.certificate);
            CHECK((!to_float || !in_doubles || certified));
            in_doubles = certified;
            tally.count(result.certificate,
                        what + ", " + std::to_string(result.certificate.meeting_count));
        }
    }
}

/// Links that are joined to the last result, one by one.
tf::mesh link_of_chain(std::size_t chain, test::random& source) {
    const auto whole = [&](std::size_t n) { return static_cast<double>(source.below(n)); };
    if (chain % 2 == 0)
        return test::moved(
            test::turned(test::box(1, 0.5, 0.25), test::random_axis(source), source.in(0, 3)),
            {source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)});
    const tf::mesh brick =
        test::moved(test::box(1 + whole(2), 1, 1), {whole(6) / 2, whole(4), whole(5)});
    return test::turned(brick, {0.3, -0.8, 0.5}, 0.7 + 0.1 * static_cast<double>(chain));
}

}  // namespace

TEST_CASE("families of hard solids are certified, and rightly, or said not to be") {
    test::certified_tally all("all families");
    for (const test::solid_family& family : test::solid_families()) {
        test::certified_tally tally{std::string(family.name)};
        for (std::size_t number = 0; number < cases_of_family(); ++number) {
            test::random source(1'000'003 * certify_seed() + number);
            check_case(family.make(number, source), std::to_string(number), tally);
        }
        MESSAGE(tally.summary());
        all.add(tally);
    }
    CHECK(all.enough());
}

TEST_CASE("chains of a hundred unions, each fed the last result, stay certified") {
    test::certified_tally tally("chains");
    constexpr std::size_t links = 100;
    for (std::size_t chain = 0; chain < 2 + cases_of_family() / 8; ++chain)
        for (const bool to_float : {false, true}) {
            test::random source(1'000'003 * certify_seed() + chain);
            tf::mesh so_far;
            for (std::size_t link = 0; link < links; ++link) {
                const std::string what = std::to_string(chain) + " link " + std::to_string(link) +
                                         (to_float ? " in floats" : " in doubles");
                CAPTURE(what);
                const tf::mesh next = link_of_chain(chain, source);
                const std::array<tf::mesh_view, 2> two{so_far, next};
                tf::boolean_result result = tf::boolean(
                    two, {"a+b", 2},
                    {.precision = to_float ? tf::precision::float32 : tf::precision::float64});
                look_at(result, to_float);
                tally.count(result.certificate,
                            what + ", " + std::to_string(result.certificate.meeting_count));
                if (!result.certificate) break;
                so_far = std::move(result.mesh);
            }
        }
    MESSAGE(tally.summary());
    CHECK(tally.enough());
}
