/// \file
/// What the detection says of two faces, filter and all, against their exact intersection alone.

#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/settings.hpp>
#include <support/stress_families.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace {

bool is_degenerate(const tf::triangle3& t) { return tf::collinear(t[0], t[1], t[2]); }

std::optional<tf::pair_kind> kind_of(const tf::test::triangle_pair& pair) {
    const tf::triangle_contact common = tf::intersect(pair.a, pair.b);
    if (common.count == 0) return std::nullopt;
    if (is_degenerate(pair.a) || is_degenerate(pair.b)) return tf::pair_kind::degenerate;
    if (common.count >= 3) return tf::pair_kind::overlap;
    return common.crossing ? tf::pair_kind::crossing : tf::pair_kind::touching;
}

}  // namespace

TEST_CASE("self_intersections: of two faces of their own corners, what their intersection says") {
    const std::uint64_t count = test::stress_count(3000);
    const std::vector<tf::face> faces{{0, 1, 2}, {3, 4, 5}};
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<tf::test::stress_family>(f);
        CAPTURE(tf::test::name_of(family));
        tf::test::stress_stream stream(family, 21);
        std::uint64_t wrong = 0, met = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const tf::test::triangle_pair pair = stream.next();
            const tf::mesh two{{pair.a[0], pair.a[1], pair.a[2], pair.b[0], pair.b[1], pair.b[2]},
                               faces};
            const auto found =
                tf::self_intersections(two, {.vertices = tf::vertex_identity::by_index}).pairs;
            const auto expected = kind_of(pair);
            met += expected.has_value();
            wrong +=
                found.size() != (expected ? 1U : 0U) || (expected && found[0].kind != *expected);
        }
        CHECK(wrong == 0);
        CHECK(met > count / 20);
    }
}
