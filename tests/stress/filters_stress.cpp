/// \file
/// What filters, short cuts and sieves decide, against integers that decide everything: predicates
/// on every family of points, pairs of triangles on every family of pairs, and whole meshes.
///
/// TREEFORM_STRESS_COUNT sets the groups of points and the pairs of each family (default 5000),
/// TREEFORM_STRESS_SEED the seed. A group is asked 20 questions. The long run:
///     TREEFORM_STRESS_COUNT=7000000 tests/stress/filters_stress
/// is 1.26e9 predicates and 1.05e8 pairs. That the integers are right is the matter of the oracle
/// tests.

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/point_families.hpp>
#include <support/settings.hpp>
#include <support/stress_families.hpp>
#include <support/stress_meshes.hpp>
#include <support/stress_placement.hpp>
#include <support/unfiltered.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tf::detail;
using tf::point3;
using tf::test::integer_orient2d;
using tf::test::integer_sign;
using tf::test::stress_family;

std::uint64_t count_of_family() { return test::stress_count(5000); }
std::uint64_t seed() { return test::stress_seed(); }

struct tally {
    std::uint64_t calls = 0;
    std::uint64_t zeros = 0;
    std::uint64_t wrong = 0;
    void add(int ours, int truth) {
        ++calls;
        zeros += truth == 0;
        wrong += ours != truth;
    }
};

/// The coordinates in turn, so that component `axis` of a vector becomes its last.
point3 turned_axes(int axis, const point3& p) {
    return axis == 0 ? point3{p.y, p.z, p.x} : axis == 1 ? point3{p.z, p.x, p.y} : p;
}

/// Nine points, every predicate.
void ask_all(const std::vector<point3>& p, tally& sum) {
    const tf::plane_points n{p[0], p[1], p[2]};
    const tf::plane_points m{p[3], p[4], p[5]};
    const tf::plane_points k{p[6], p[7], p[8]};
    const auto flat = [&](std::size_t i) { return tf::point2{p[i].x, p[i].y}; };
    sum.add(tf::orient2d(flat(3), flat(4), flat(5)), integer_orient2d(2, p[3], p[4], p[5]));
    sum.add(tf::collinear(p[6], p[7], p[8]) ? 0 : 1,
            integer_sign<exact::normal_polynomial>(p[6], p[7], p[8]));
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}, std::size_t{5}}) {
        sum.add(tf::orient3d(p[i], p[i + 1], p[i + 2], p[i + 3]),
                integer_sign<exact::orient3d_polynomial>(p[i], p[i + 1], p[i + 2], p[i + 3]));
        sum.add(tf::compare_along(p[i], p[i + 1], p[i + 2], p[i + 3]),
                integer_sign<exact::compare_along_polynomial>(p[i], p[i + 1], p[i + 2], p[i + 3]));
        sum.add(tf::compare_distance(p[i], p[i + 1], p[i], p[i + 3]),
                integer_sign<exact::compare_distance_polynomial>(p[i], p[i + 1], p[i], p[i + 3]));
    }
    sum.add(tf::normal_dot(n, m),
            integer_sign<exact::normal_dot_polynomial>(n.a, n.b, n.c, m.a, m.b, m.c));
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](const point3& q) { return turned_axes(axis, q); };
        sum.add(tf::orient2d(axis, p[0], p[4], p[8]), integer_orient2d(axis, p[0], p[4], p[8]));
        sum.add(tf::normal_cross(axis, n, m),
                integer_sign<exact::normal_cross_polynomial>(at(n.a), at(n.b), at(n.c), at(m.a),
                                                             at(m.b), at(m.c)));
    }
    sum.add(tf::normal_turn(n, m, p[7], p[8]),
            integer_sign<exact::normal_turn_polynomial>(n.a, n.b, n.c, m.a, m.b, m.c, p[7], p[8]));
    sum.add(tf::normal_determinant(n, m, k), integer_sign<exact::normal_determinant_polynomial>(
                                                 n.a, n.b, n.c, m.a, m.b, m.c, k.a, k.b, k.c));
}

/// Each face with corners of its own.
tf::mesh as_soup(const tf::mesh& mesh) {
    tf::mesh soup;
    for (const tf::face& f : mesh.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : f) soup.points.push_back(mesh.points[corner]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

using pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

pairs all_that_meet(const tf::mesh& soup) {
    const auto corners = [&](std::uint32_t f) {
        return tf::triangle3{soup.points[3 * f], soup.points[3 * f + 1], soup.points[3 * f + 2]};
    };
    pairs found;
    for (std::uint32_t a = 0; a < soup.faces.size(); ++a)
        for (std::uint32_t b = a + 1; b < soup.faces.size(); ++b)
            if (tf::intersect(corners(a), corners(b)).count != 0) found.emplace_back(a, b);
    return found;
}

}  // namespace

TEST_CASE("every predicate says what integers say") {
    tally all;
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        const std::string family(tf::test::point_family_names[f]);
        CAPTURE(family);
        tf::test::point_stream stream(static_cast<tf::test::point_family>(f), 40 * seed() + f);
        tally sum;
        for (std::uint64_t i = 0; i < count_of_family(); ++i) ask_all(stream.next(9), sum);
        std::printf("%-16s %12llu predicates %12llu zero %4llu wrong\n", family.c_str(),
                    static_cast<unsigned long long>(sum.calls),
                    static_cast<unsigned long long>(sum.zeros),
                    static_cast<unsigned long long>(sum.wrong));
        std::fflush(stdout);
        CHECK(sum.wrong == 0);
        all.calls += sum.calls;
    }
    MESSAGE(all.calls << " predicates");
}

TEST_CASE("every pair of triangles is classified as integers classify it") {
    std::uint64_t all = 0;
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<stress_family>(f);
        CAPTURE(name_of(family));
        tf::test::stress_stream stream(family, 100 * seed() + f);
        std::uint64_t proper = 0;
        std::uint64_t meet = 0;
        for (std::uint64_t i = 0; i < count_of_family(); ++i) {
            const tf::test::triangle_pair pair = stream.next();
            const auto truth = tf::test::unfiltered_contacts::of(pair.a, pair.b);
            if (!truth) continue;
            ++proper;
            meet += truth->count() > 0;
            if (truth->agrees(tf::intersect(pair.a, pair.b))) continue;
            INFO("pair " << i);
            FAIL_CHECK("another answer");
        }
        std::printf("%-16s %12llu proper pairs %12llu meet\n", std::string(name_of(family)).c_str(),
                    static_cast<unsigned long long>(proper), static_cast<unsigned long long>(meet));
        std::fflush(stdout);
        all += proper;
    }
    MESSAGE(all << " pairs");
}

TEST_CASE("no pair of faces is lost in a sieve") {
    tf::test::random_source random(seed());
    std::uint64_t all = 0;
    for (std::uint64_t i = 0; i < std::max<std::uint64_t>(1, count_of_family() / 1000); ++i)
        for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
            const auto family = static_cast<stress_family>(f);
            CAPTURE(name_of(family));
            CAPTURE(i);
            tf::mesh soup = as_soup(stress_mesh(family, 8 + random.below(120), seed() + i));
            if (family != stress_family::extreme_range)
                soup = placed(soup, tf::test::random_placement(random));
            pairs found;
            for (const tf::face_pair& pair :
                 tf::self_intersections(soup, {.vertices = tf::vertex_identity::by_index}).pairs)
                found.emplace_back(pair.a, pair.b);
            CHECK(found == all_that_meet(soup));
            all += soup.faces.size() * (soup.faces.size() - 1) / 2;
        }
    MESSAGE(all << " pairs of faces");
}
