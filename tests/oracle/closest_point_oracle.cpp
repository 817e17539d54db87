/// \file
/// `tf::closest_point` and `tf::closest_pair` against exact rational geometry: the stated error
/// bound, on slivers, needles, degenerate triangles, far and mixed coordinates.

#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/stress_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace {

using vec = std::array<mpq_class, 3>;

vec exact(const tf::point3& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }
vec difference(const vec& a, const vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class dot(const vec& a, const vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
vec cross(const vec& a, const vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class exact_to_segment(const vec& p, const vec& a, const vec& b) {
    const vec e = difference(b, a);
    mpq_class t = 0;
    if (dot(e, e) != 0) t = dot(difference(p, a), e) / dot(e, e);
    if (t < 0) t = 0;
    if (t > 1) t = 1;
    vec gap = difference(p, a);
    for (std::size_t k = 0; k < 3; ++k) gap[k] -= t * e[k];
    return dot(gap, gap);
}

mpq_class exact_to_triangle(const vec& p, const std::array<vec, 3>& t) {
    mpq_class best = std::min({exact_to_segment(p, t[0], t[1]), exact_to_segment(p, t[1], t[2]),
                               exact_to_segment(p, t[2], t[0])});
    const vec n = cross(difference(t[1], t[0]), difference(t[2], t[0]));
    const mpq_class square = dot(n, n);
    if (square == 0) return best;
    for (std::size_t i = 0; i < 3; ++i)
        if (dot(cross(difference(t[(i + 1) % 3], t[i]), difference(p, t[i])), n) < 0) return best;
    const mpq_class height = dot(n, difference(p, t[0]));
    return std::min(best, mpq_class(height * height / square));
}

mpq_class between_segments(const vec& p, const vec& p2, const vec& q, const vec& q2) {
    mpq_class best = std::min({exact_to_segment(p, q, q2), exact_to_segment(p2, q, q2),
                               exact_to_segment(q, p, p2), exact_to_segment(q2, p, p2)});
    const vec d = difference(p2, p), e = difference(q2, q), r = difference(p, q);
    const mpq_class determinant = dot(d, d) * dot(e, e) - dot(d, e) * dot(d, e);
    if (determinant == 0) return best;
    const mpq_class s = (dot(d, e) * dot(e, r) - dot(d, r) * dot(e, e)) / determinant;
    const mpq_class t = (dot(d, d) * dot(e, r) - dot(d, e) * dot(d, r)) / determinant;
    if (s < 0 || s > 1 || t < 0 || t > 1) return best;
    vec gap = r;
    for (std::size_t k = 0; k < 3; ++k) gap[k] += s * d[k] - t * e[k];
    return std::min(best, dot(gap, gap));
}

mpq_class between_triangles(const std::array<vec, 3>& a, const std::array<vec, 3>& b) {
    mpq_class best = exact_to_triangle(a[0], b);
    for (std::size_t i = 0; i < 3; ++i) {
        best = std::min({best, exact_to_triangle(a[i], b), exact_to_triangle(b[i], a)});
        for (std::size_t j = 0; j < 3; ++j)
            best = std::min(best, between_segments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
    return best;
}

std::array<vec, 3> exact(const tf::triangle3& t) { return {exact(t[0]), exact(t[1]), exact(t[2])}; }

double length(const tf::point3& a, const tf::point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

TEST_CASE("closest point: the distance is within its bound of the exact one") {
    double worst = 0.0;
    for (std::size_t family = 0; family < tf::test::stress_family_count; ++family) {
        const auto which = static_cast<tf::test::stress_family>(family);
        CAPTURE(tf::test::name_of(which));
        tf::test::stress_stream stream(which, 1);
        for (int i = 0; i < 4000; ++i) {
            const auto [a, b] = stream.next();
            const tf::point3 p = b[static_cast<std::size_t>(i) % 3];
            double size = 0.0;
            for (std::size_t j = 0; j < 3; ++j)
                size = std::max({size, length(a[j], p), length(a[j], a[(j + 1) % 3])});
            if (!(size > 1e-140 && size < 1e150)) continue;
            const double found = std::sqrt(tf::closest_point(a, p).squared_distance);
            // Scaled, as the exact square may not be a double.
            mpq_class square = exact_to_triangle(exact(p), {exact(a[0]), exact(a[1]), exact(a[2])});
            square /= mpq_class(size) * mpq_class(size);
            const double error = std::abs(found / size - std::sqrt(square.get_d()));
            worst = std::max(worst, error * 0x1p53);
            REQUIRE(error <= 8.0 * 0x1p-53);
        }
    }
    MESSAGE("largest error in units of 2^-53 L: " << worst);
}

TEST_CASE("closest points: the distance of two triangles is within its bound, and 0 if they meet") {
    double worst = 0.0;
    std::size_t meeting = 0;
    for (std::size_t family = 0; family < tf::test::stress_family_count; ++family) {
        const auto which = static_cast<tf::test::stress_family>(family);
        CAPTURE(tf::test::name_of(which));
        tf::test::stress_stream stream(which, 2);
        for (int i = 0; i < 1000; ++i) {
            const auto [a, b] = stream.next();
            double size = 0.0;
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k)
                    size = std::max(
                        {size, length(a[j], b[k]), length(a[j], a[k]), length(b[j], b[k])});
            if (!(size > 1e-140 && size < 1e150)) continue;
            const auto found = tf::closest_pair(a, b);
            const bool meet = tf::intersect(a, b).count != 0;
            REQUIRE((found.squared_distance == 0.0) == meet);
            if (meet) {
                ++meeting;
                continue;
            }
            mpq_class square = between_triangles(exact(a), exact(b));
            square /= mpq_class(size) * mpq_class(size);
            const double error =
                std::abs(std::sqrt(found.squared_distance) / size - std::sqrt(square.get_d()));
            worst = std::max(worst, error * 0x1p53);
            REQUIRE(error <= 8.0 * 0x1p-53);
        }
    }
    CHECK(meeting > 1000);
    MESSAGE("largest error in units of 2^-53 L: " << worst);
}
