/// \file
/// `tf::intersect` against exact rational geometry on every family of hard pairs:
///   - `CGAL::do_intersect` of the exact kernel says whether the pair meets;
///   - the reference (half-space clipping in GMP integers) says how, end by end, by name;
///   - `CGAL::intersection` says which points the ends are, and the reference must agree;
///   - the library's integers alone, by which tests/stress judges the filters, say the same.
///
/// Pairs a family: 2000, or $TREEFORM_STRESS_COUNT. The long run, after building this target:
///   TREEFORM_STRESS_COUNT=100000000 TREEFORM_STRESS_SEED=7 tests/oracle/triangle_triangle_oracle
/// $TREEFORM_STRESS_FAMILY (a name below) confines it to one family, so that families can run side
/// by side. CGAL::intersection is asked about the first 10^5 pairs of each.

#include "support/gmp_lattice.hpp"
#include "support/settings.hpp"
#include "support/stress_families.hpp"
#include "support/unfiltered.hpp"
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <doctest/doctest.h>
#include <fmt/core.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace {

using tf::triangle3;
using tf::triangle_contact;
using tf::test::lattice_pair;
using tf::test::reference_contact;
using tf::test::stress_family;
using tf::test::triangle_pair;
using exact_reference = tf::test::gmp_reference;
using exact_triangle = tf::test::gmp_triangle;

// --- CGAL's view of a pair ---

using exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using cgal_shape =
    std::variant<exact_kernel::Point_3, exact_kernel::Segment_3, exact_kernel::Triangle_3>;

exact_kernel::Point_3 cgal_point(const tf::point3& p) { return {p.x, p.y, p.z}; }

/// CGAL asks for triangles that are not degenerate, so those are handed over as what they are.
cgal_shape shape_of(const triangle3& t, const exact_triangle& lattice) {
    const auto corners = exact_reference::extreme_corners(lattice);
    if (corners.size() == 3)
        return exact_kernel::Triangle_3(cgal_point(t[0]), cgal_point(t[1]), cgal_point(t[2]));
    const auto find = [&](const auto& corner) {
        const auto at = std::find(lattice.begin(), lattice.end(), corner.x) - lattice.begin();
        return cgal_point(t[static_cast<std::size_t>(at)]);
    };
    if (corners.size() == 1) return find(corners[0]);
    return exact_kernel::Segment_3(find(corners[0]), find(corners[1]));
}

struct cgal_meet {
    template <class A, class B>
    bool operator()(const A& a, const B& b) const {
        return CGAL::do_intersect(a, b);
    }
    bool operator()(const exact_kernel::Point_3& a, const exact_kernel::Point_3& b) const {
        return a == b;
    }
};

/// Corners of what two triangles share, as CGAL constructs it.
std::vector<exact_kernel::Point_3> cgal_corners(const exact_kernel::Triangle_3& a,
                                                const exact_kernel::Triangle_3& b) {
    std::vector<exact_kernel::Point_3> corners;
    const auto common = CGAL::intersection(a, b);
    if (!common) return corners;
    if (const auto* point = boost::get<exact_kernel::Point_3>(&*common)) return {*point};
    if (const auto* segment = boost::get<exact_kernel::Segment_3>(&*common))
        return {segment->source(), segment->target()};
    if (const auto* triangle = boost::get<exact_kernel::Triangle_3>(&*common))
        return {triangle->vertex(0), triangle->vertex(1), triangle->vertex(2)};
    return boost::get<std::vector<exact_kernel::Point_3>>(*common);
}

/// CGAL's exact number is GMP's own or Boost's wrapper of it, as it was configured.
template <class Rational>
mpq_class rational(const Rational& x) {
    if constexpr (std::is_convertible_v<Rational, mpq_class>)
        return x;
    else
        return mpq_class(x.backend().data());
}

bool same_point(const exact_kernel::Point_3& p, const tf::test::homogeneous<mpz_class>& q,
                int exponent) {
    const auto coordinate = [&](std::size_t axis) {
        mpq_class value(q.x[axis], q.w);
        value.canonicalize();
        const auto shift = static_cast<unsigned long>(std::abs(exponent));
        return exponent < 0 ? mpq_class(value >> shift) : mpq_class(value << shift);
    };
    const auto equal = [&](const exact_kernel::FT& x, std::size_t axis) {
        return rational(CGAL::exact(x)) == coordinate(axis);
    };
    return equal(p.x(), 0) && equal(p.y(), 1) && equal(p.z(), 2);
}

/// Whether the two sets of points are one, as exact rationals.
bool same_points(const std::vector<exact_kernel::Point_3>& found, const exact_reference& reference,
                 int exponent) {
    const auto& expected = reference.points();
    return found.size() == expected.size() &&
           std::all_of(found.begin(), found.end(), [&](const exact_kernel::Point_3& p) {
               return std::any_of(expected.begin(), expected.end(),
                                  [&](const auto& q) { return same_point(p, q, exponent); });
           });
}

// --- the run ---

struct pair_tally {
    std::array<std::uint64_t, 4> kinds{};
    std::uint64_t degenerate = 0;
    std::uint64_t crossing = 0;
    std::uint64_t wrong_verdicts = 0;   ///< meets or not, against CGAL::do_intersect
    std::uint64_t wrong_classes = 0;    ///< kind, flags or ends, against the reference
    std::uint64_t wrong_reference = 0;  ///< ends of the reference, against CGAL::intersection
    std::uint64_t wrong_swapped = 0;    ///< operands exchanged
};

std::string describe(const triangle_pair& pair) {
    std::string text;
    for (const triangle3* t : {&pair.a, &pair.b})
        for (const tf::point3& p : *t) text += fmt::format(" {:a},{:a},{:a}", p.x, p.y, p.z);
    return text;
}

/// Whether the answer for (b, a) is the mirror image of the one for (a, b). An area's corners come
/// in another order then, so the ends are compared as a set.
bool mirrors(const triangle_contact& swapped, const triangle_contact& found) {
    const auto has = [&](tf::feature_pair c) {
        return std::find(found.ends.begin(), found.ends.begin() + found.count,
                         tf::feature_pair{c.on_b, c.on_a}) != found.ends.begin() + found.count;
    };
    return swapped.coplanar == found.coplanar && swapped.crossing == found.crossing &&
           swapped.count == found.count &&
           std::all_of(swapped.ends.begin(), swapped.ends.begin() + swapped.count, has);
}

void check_pair(const triangle_pair& pair, bool with_points, pair_tally& sum) {
    const triangle_contact found = tf::intersect(pair.a, pair.b);
    const lattice_pair lattice = on_lattice(pair);
    const exact_reference reference(lattice.a, lattice.b);
    const reference_contact& expected = reference.answer();
    ++sum.kinds[std::min<std::size_t>(expected.ends.size(), 3)];
    sum.degenerate += expected.degenerate;
    sum.crossing += expected.crossing;

    const cgal_shape a = shape_of(pair.a, lattice.a);
    const cgal_shape b = shape_of(pair.b, lattice.b);
    const auto fail = [&](std::uint64_t& count, const char* what) {
        ++count;
        MESSAGE(what << describe(pair));
    };
    if (std::visit(cgal_meet{}, a, b) != (found.count != 0)) fail(sum.wrong_verdicts, "verdict");
    if (!agrees(found, expected)) fail(sum.wrong_classes, "class");
    if (const auto truth = tf::test::unfiltered_contacts::of(pair.a, pair.b);
        truth.has_value() == expected.degenerate || (truth && !truth->agrees(found)))
        fail(sum.wrong_classes, "the library's integers alone");
    if (!mirrors(tf::intersect(pair.b, pair.a), found)) fail(sum.wrong_swapped, "swapped");
    if (with_points && !expected.degenerate &&
        !same_points(cgal_corners(std::get<exact_kernel::Triangle_3>(a),
                                  std::get<exact_kernel::Triangle_3>(b)),
                     reference, lattice.exponent))
        fail(sum.wrong_reference, "points");
}

}  // namespace

TEST_CASE("every verdict and every class is that of exact rational geometry") {
    const std::uint64_t count = test::stress_count(2000);
    const std::uint64_t seed = test::stress_seed();
    const char* only = std::getenv("TREEFORM_STRESS_FAMILY");
    fmt::print("{:<16}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>9}{:>9}\n", "family",
               "pairs", "none", "point", "segment", "area", "crossing", "degenerate", "verdicts",
               "classes", "swapped", "points");
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<stress_family>(f);
        if (only != nullptr && name_of(family) != only) continue;
        tf::test::stress_stream stream(family, seed);
        pair_tally sum;
        for (std::uint64_t i = 0; i < count; ++i) check_pair(stream.next(), i < 100'000, sum);
        fmt::print("{:<16}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>9}{:>9}{:>9}{:>9}\n",
                   name_of(family), count, sum.kinds[0], sum.kinds[1], sum.kinds[2], sum.kinds[3],
                   sum.crossing, sum.degenerate, sum.wrong_verdicts, sum.wrong_classes,
                   sum.wrong_swapped, sum.wrong_reference);
        std::fflush(stdout);
        CHECK(sum.wrong_verdicts == 0);
        CHECK(sum.wrong_classes == 0);
        CHECK(sum.wrong_swapped == 0);
        CHECK(sum.wrong_reference == 0);
        CHECK(sum.kinds[0] > count / 50);
        CHECK(sum.kinds[1] + sum.kinds[2] + sum.kinds[3] > count / 20);
    }
}
