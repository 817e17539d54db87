/// \file
/// The first contact of triangles in motion against its definition in rationals.
///
/// TREEFORM_STRESS_COUNT sets the pairs of each family (default 1100, of which some meet where they
/// are and are passed over).

#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/reference_sweep.hpp>
#include <support/settings.hpp>
#include <support/stress_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace {

using tf::point3;
using tf::triangle3;
using tf::test::first_time;
using tf::test::rational;
using tf::test::rational_point;

mpq_class exact_time(const point3& d, const tf::sweep_contact& c) {
    const auto minus = [](const point3& x, const point3& y) {
        const rational_point p = rational(x), q = rational(y);
        return rational_point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    };
    const rational_point u = minus(c.until.u_to, c.until.u_from);
    const rational_point v = minus(c.until.v_to, c.until.v_from);
    const rational_point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                           u[0] * v[1] - u[1] * v[0]};
    const rational_point r = minus(c.until.at, c.from);
    const rational_point e = rational(d);
    return mpq_class(n[0] * r[0] + n[1] * r[1] + n[2] * r[2]) /
           mpq_class(n[0] * e[0] + n[1] * e[1] + n[2] * e[2]);
}

point3 difference(const point3& x, const point3& y) { return {x.x - y.x, x.y - y.y, x.z - y.z}; }

/// A direction that is likely to bring corners, edges and faces together, or to let them graze.
point3 direction_for(const tf::test::triangle_pair& pair, tf::test::random_source& random) {
    const auto corner = [&](const triangle3& t) { return t[random.below(3)]; };
    switch (random.below(5)) {
        case 0:
            return difference(corner(pair.b), corner(pair.a));
        case 1: {
            const point3 p = corner(pair.b), q = corner(pair.b), r = corner(pair.a);
            return difference({(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2}, r);
        }
        case 2: {
            point3 axis{};
            axis[random.below(3)] = random.one_in(2) ? 1.0 : -1.0;
            return axis;
        }
        case 3:
            return difference(corner(pair.b), corner(pair.b));
        default: {
            const point3 p = corner(pair.b), q = corner(pair.b);
            const double s = random.unit();
            const point3 target{p.x + s * (q.x - p.x), p.y + s * (q.y - p.y),
                                p.z + s * (q.z - p.z)};
            return difference(target, corner(pair.a));
        }
    }
}

bool finite(const triangle3& t) {
    return std::all_of(t.begin(), t.end(), [](const point3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

struct sweep_tally {
    std::uint64_t asked = 0, hits = 0, flat = 0, wrong = 0, far_off = 0;
};

void check(const triangle3& a, const triangle3& b, const point3& d,
           const std::optional<mpq_class>& truth, sweep_tally& sum) {
    ++sum.asked;
    const auto ours = tf::first_contact(a, b, d);
    if (ours.has_value() != truth.has_value()) {
        ++sum.wrong;
        return;
    }
    if (!ours) return;
    ++sum.hits;
    const mpq_class exact = exact_time(d, *ours);
    sum.wrong += exact != *truth;
    sum.flat += ours->until.u_from == point3{};
    const mpq_class error = abs(mpq_class(std::isfinite(ours->time) ? ours->time : 0.0) - exact);
    if (exact < mpq_class(0x1p1000) && exact > mpq_class(0x1p-1000))
        sum.far_off += error * mpq_class(0x1p40) > exact;
    else if (exact == 0)
        sum.far_off += ours->time != 0.0;
}

}  // namespace

TEST_CASE("first contact is the least time of the definition, in every family") {
    const std::uint64_t count = test::stress_count(1100);
    std::uint64_t pairs = 0, hits = 0, flat = 0;
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<tf::test::stress_family>(f);
        tf::test::stress_stream stream(family, 31 + f);
        tf::test::random_source random(77 + f);
        sweep_tally sum;
        for (std::uint64_t i = 0; i < count; ++i) {
            tf::test::triangle_pair pair = stream.next();
            const point3 d = direction_for(pair, random);
            if (!finite({d, d, d})) continue;
            // Most pairs meet where they are: back off against the motion.
            const double back = random.whole(0, 3);
            for (point3& p : pair.a)
                for (std::size_t k = 0; k < 3; ++k) p[k] -= back * d[k];
            if (!finite(pair.a)) continue;
            if (tf::intersect(pair.a, pair.b).count != 0) continue;
            const auto truth = first_time(pair.a, pair.b, d);
            check(pair.a, pair.b, d, truth, sum);
            check(pair.b, pair.a, {-d.x, -d.y, -d.z}, truth, sum);
        }
        std::printf(
            "%-16s %6llu asked %6llu hits %5llu flat %llu wrong %llu far off\n",
            std::string(name_of(family)).c_str(), static_cast<unsigned long long>(sum.asked),
            static_cast<unsigned long long>(sum.hits), static_cast<unsigned long long>(sum.flat),
            static_cast<unsigned long long>(sum.wrong),
            static_cast<unsigned long long>(sum.far_off));
        CHECK(sum.wrong == 0);
        CHECK(sum.far_off == 0);
        pairs += sum.asked / 2;
        hits += sum.hits;
        flat += sum.flat;
    }
    MESSAGE(pairs << " pairs, each from both sides; " << hits << " contacts");
    if (count >= 1100) CHECK(pairs >= 10'000);
    CHECK(hits > count);
    CHECK(flat > 0);
}
