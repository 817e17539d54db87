/// \file
/// Affine maps: what they do to points, and one after another.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <limits>
#include <stdexcept>

namespace {

constexpr tf::transform<2> quarter_turn{{{{0, -1, 0}, {1, 0, 0}}}};

}  // namespace

TEST_CASE("transform: as constructed it leaves every point where it is") {
    CHECK(tf::transform<3>{}(tf::point3{1.5, -2.0, 1e300}) == tf::point3{1.5, -2.0, 1e300});
    CHECK(tf::transform<2>{}(tf::point2{0.1, -0.2}) == tf::point2{0.1, -0.2});
}

TEST_CASE("transform: rows hold the matrix and then the translation") {
    CHECK(quarter_turn(tf::point2{1, 2}) == tf::point2{-2, 1});
    CHECK(tf::transform<2>::translation(tf::point2{3, 4})(tf::point2{1, 2}) == tf::point2{4, 6});
    const tf::transform<3> shear{{{{1, 2, 3, 4}, {0, 1, 0, 5}, {0, 0, 1, 6}}}};
    CHECK(shear(tf::point3{1, 10, 100}) == tf::point3{325, 15, 106});
}

TEST_CASE("transform: quarter turns about coordinate axes are exact, others keep lengths") {
    using map = tf::transform<3>;
    const tf::point3 p{1, 2, 3};
    CHECK(map::rotation(tf::point3{0, 0, 1}, 90)(p) == tf::point3{-2, 1, 3});
    CHECK(map::rotation(tf::point3{0, 0, -7}, 90)(p) == tf::point3{2, -1, 3});
    CHECK(map::rotation(tf::point3{2, 0, 0}, 180)(p) == tf::point3{1, -2, -3});
    CHECK(map::rotation(tf::point3{0, 1, 0}, -450)(p) == tf::point3{-3, 2, 1});
    CHECK(map::rotation(tf::point3{0, 1, 0}, 360)(p) == p);
    const tf::point3 half = map::rotation(tf::point3{1, 1, 1}, 120)(p);  // permutes the axes
    for (std::size_t k = 0; k < 3; ++k) CHECK(half[k] == doctest::Approx(p[(k + 2) % 3]));
    CHECK(map::rotation(tf::point3{0, 0, 1}, 30)(tf::point3{2, 0, 0}).y == doctest::Approx(1.0));
    CHECK_THROWS_AS((void)map::rotation(tf::point3{}, 90), std::invalid_argument);
    CHECK_THROWS_AS(
        (void)map::rotation(tf::point3{1, 0, 0}, std::numeric_limits<double>::infinity()),
        std::invalid_argument);
}

TEST_CASE("transform: `after` is the outer map of what the inner one gives") {
    const tf::transform<2> move = tf::transform<2>::translation(tf::point2{3, 4});
    const tf::point2 p{1, 2};
    CHECK(quarter_turn.after(move)(p) == quarter_turn(move(p)));
    CHECK(move.after(quarter_turn)(p) == move(quarter_turn(p)));
    CHECK(move.after(quarter_turn) != quarter_turn.after(move));
}

TEST_CASE("transform: `inverse` undoes a map, exactly where nothing is rounded") {
    const tf::transform<3> exact{{{{0, -2, 0, 3}, {0, 0, 4, -5}, {0.5, 0, 0, 1e9}}}};
    CHECK(exact.inverse().after(exact) == tf::transform<3>{});
    CHECK(exact.after(exact.inverse()) == tf::transform<3>{});
    CHECK(quarter_turn.inverse()(quarter_turn(tf::point2{3, 4})) == tf::point2{3, 4});
    const tf::transform<3> skew{{{{1, 2, 3, 4}, {0, 1, 5, 5}, {7, 0, 1, 6}}}};
    const tf::transform<3> around = skew.inverse().after(skew);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            CHECK(around.rows[i][j] == doctest::Approx(i == j ? 1.0 : 0.0).epsilon(1e-13));
    const tf::transform<3> flat{{{{1, 2, 3, 4}, {2, 4, 6, 5}, {7, 0, 1, 6}}}};
    CHECK_THROWS_AS(static_cast<void>(flat.inverse()), std::invalid_argument);
}

TEST_CASE("transform: mirrors where its determinant is negative") {
    CHECK_FALSE(tf::transform<3>{}.mirrors());
    CHECK_FALSE(quarter_turn.mirrors());
    CHECK(tf::transform<2>{{{{0, 1, 5}, {1, 0, 5}}}}.mirrors());
    for (int bits = 0; bits < 8; ++bits) {
        tf::transform<3> scale, turned{{{{0, 3, 0, 1}, {0, 0, 2, 1}, {1, 0, 0, 1}}}};
        bool odd = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool negative = (bits >> k & 1) != 0;
            scale.rows[k][k] = negative ? -1.0 : 1.0;
            odd = odd != negative;
        }
        CHECK(scale.mirrors() == odd);
        CHECK(turned.after(scale).mirrors() == odd);
    }
    CHECK_FALSE(tf::transform<3>{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}}}.mirrors());
}

TEST_CASE("transform: knows whether an entry is NaN or infinite") {
    tf::transform<3> map;
    CHECK(map.finite());
    map.rows[1][3] = std::numeric_limits<double>::infinity();
    CHECK_FALSE(map.finite());
    map.rows[1][3] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(map.finite());
}
