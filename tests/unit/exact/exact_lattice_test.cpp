#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/lattice.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/point_families.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace {

namespace detail = treeform::detail;
using detail::exact::odd_part_of;
using test::greatest;
using test::least;
using tf::test::point_family;

detail::exact::lattice lattice_of(const std::vector<double>& numbers) {
    detail::exact::lattice grid;
    for (const double x : numbers) grid.add(odd_part_of(x));
    return grid;
}

TEST_CASE("a double is its odd part at the lowest set bit") {
    CHECK(odd_part_of(1.0).odd == 1);
    CHECK(odd_part_of(1.0).lowest == 1075);
    CHECK(odd_part_of(1.0).highest == 1076);
    CHECK(odd_part_of(-12.0).odd == 3);
    CHECK(odd_part_of(-12.0).lowest == 1077);
    CHECK(odd_part_of(-12.0).highest == 1079);
    CHECK(odd_part_of(-12.0).negative == ~std::uint64_t{0});
    CHECK(odd_part_of(least).odd == 1);
    CHECK(odd_part_of(least).lowest == 1);
    CHECK(odd_part_of(least).highest == 2);
    CHECK(odd_part_of(greatest).odd == (std::uint64_t{1} << 53) - 1);
    CHECK(odd_part_of(greatest).lowest == 2046);
    CHECK(odd_part_of(greatest).highest == 2099);
    CHECK(odd_part_of(-0.0).odd == 0);
    CHECK(odd_part_of(-0.0).lowest == detail::exact::odd_part::no_bit);
}

TEST_CASE("a lattice is as coarse as its numbers allow, and zeros ask for nothing") {
    CHECK(lattice_of({0.0, -0.0}).bits() <= 0);
    CHECK(lattice_of({1.0}).bits() == 1);
    CHECK(lattice_of({1e300, 0.0}).bits() == lattice_of({1e300}).bits());
    CHECK(lattice_of({8.0, 24.0}).bits() == 2);
    CHECK(lattice_of({1.0, 0x1p62}).bits() == 63);
    CHECK(lattice_of({least, 3 * least}).bits() == 2);
    CHECK(lattice_of({least, -greatest}).bits() == 2098);
}

TEST_CASE("coordinates keep their value at every width, limb boundaries included") {
    for (int shift = 0; shift < 2046; ++shift) {
        const double x = std::ldexp(-5.0, shift - 1074);
        const detail::exact::lattice grid = lattice_of({least, x});
        const auto widest = detail::exact::integer_on<33>(grid, odd_part_of(x));
        // -5 * 2^shift, told by its negative
        const auto negated = detail::exact::integer<33>{} - widest;
        for (std::size_t limb = 0; limb < 33; ++limb) {
            std::uint64_t expected = 0;
            for (const int bit : {shift, shift + 2})
                if (static_cast<std::size_t>(bit / 64) == limb)
                    expected |= std::uint64_t{1} << (bit % 64);
            REQUIRE(negated.limbs[limb] == expected);
        }
        if (grid.bits() <= 126) {
            const auto narrow = detail::exact::integer_on<2>(grid, odd_part_of(x));
            REQUIRE(narrow.limbs[0] == widest.limbs[0]);
            REQUIRE(narrow.limbs[1] == widest.limbs[1]);
        }
        if (grid.bits() <= 62)
            REQUIRE(detail::exact::word_on(grid, odd_part_of(x)).value ==
                    -5 * (std::int64_t{1} << shift));
    }
}

TEST_CASE("words are taken only where they return to the coordinate") {
    const auto returns = [](double largest, double x, std::int64_t value) {
        std::uint64_t differing = 0;
        const detail::exact::word_scale scale(largest);
        REQUIRE(scale.usable());
        const bool same = scale.word_of(x, differing).value == value;
        return same && differing << 1 == 0;
    };
    // 1 is scaled to 2^61
    CHECK(returns(1.0, 1.0, std::int64_t{1} << 61));
    CHECK(returns(1.5, -1.5, -(std::int64_t{3} << 60)));
    CHECK(returns(1.0, 0.0, 0));
    CHECK(returns(1.0, -0.0, 0));
    CHECK(returns(1.0, 0x1p-61, 1));
    CHECK(returns(1.0, -0x1p-61, -1));
    CHECK_FALSE(returns(1.0, 0x1p-62, 0));
    CHECK_FALSE(returns(1.0, 0x1.8p-61, 1));
    CHECK_FALSE(returns(1.0, least, 0));
    CHECK_FALSE(returns(greatest, 1.0, 0));
    CHECK(returns(greatest, greatest, ((std::int64_t{1} << 53) - 1) * 512));
    CHECK_FALSE(detail::exact::word_scale(0.0).usable());
    CHECK_FALSE(detail::exact::word_scale(0x1p-1000).usable());
    CHECK(detail::exact::word_scale(0x1p-961).usable());
    CHECK_FALSE(detail::exact::word_scale(0x1.fffffffffffffp-962).usable());
    CHECK(returns(0x1p-961, -0x1p-1022, -1));
    CHECK_FALSE(returns(0x1p-961, 0x1p-1023, 0));
}

/// Signs at every width that is wide enough, and that of the stage as called: all must agree.
template <class Polynomial>
void check_widths(const detail::exact::points_of<Polynomial, double>& points) {
    const auto parts = detail::exact::transform(points, odd_part_of);
    detail::exact::lattice grid;
    detail::exact::for_each_component(parts,
                                      [&](const detail::exact::odd_part& p) { grid.add(p); });
    const int expected = detail::exact::sign_at_width<Polynomial, 6>(grid, parts);
    [&]<std::size_t... Classes>(std::index_sequence<Classes...>) {
        const auto check = [&]<std::size_t Class>() {
            if (grid.bits() <= detail::exact::most_bits<Polynomial>(Class))
                REQUIRE(detail::exact::sign_at_width<Polynomial, Class>(grid, parts) == expected);
        };
        (check.template operator()<Classes>(), ...);
    }
    (std::make_index_sequence<6>{});
    tf::predicate_counters counters;
    REQUIRE(detail::exact::exact_sign<Polynomial>(points, &counters) == expected);
    REQUIRE(counters.by_width[detail::exact::width_class_of<Polynomial>(grid.bits())] == 1);
}

template <class Polynomial>
detail::exact::points_of<Polynomial, double> points_for(const std::vector<tf::point3>& points) {
    detail::exact::points_of<Polynomial, double> result{};
    for (std::size_t i = 0; i < Polynomial::points; ++i) {
        if constexpr (Polynomial::template vector<double>::axes == 2)
            result[i] = {points[i].x, points[i].y};
        else
            result[i] = {points[i].x, points[i].y, points[i].z};
    }
    return result;
}

/// Points as large as a width takes them: whole numbers of `bits` bits, among them 1.
std::vector<tf::point3> points_at_the_edge(tf::test::random_source& random, int bits) {
    const double edge = std::ldexp(0x1.fffffffffffffp-1, bits);
    std::vector<tf::point3> points(9);
    for (tf::point3& p : points)
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = random.one_in(8) ? 1.0 : random.one_in(2) ? edge : -edge;
    points[0].x = edge;
    points[1].x = 1.0;
    return points;
}

template <class Polynomial>
void check_polynomial() {
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        CAPTURE(tf::test::point_family_names[f]);
        tf::test::point_stream stream(static_cast<point_family>(f), 77);
        for (int i = 0; i < 60; ++i)
            check_widths<Polynomial>(points_for<Polynomial>(stream.next(9)));
    }
    tf::test::random_source random(5);
    for (std::size_t width_class = 0; width_class < 6; ++width_class) {
        // The widest lattice of the class, and one bit more; 1023 bits is as far as 1 is in it.
        const int bits = detail::exact::most_bits<Polynomial>(width_class);
        for (int i = 0; i < 60; ++i)
            for (const int more : {0, 1})
                check_widths<Polynomial>(
                    points_for<Polynomial>(points_at_the_edge(random, bits + more)));
    }
}

TEST_CASE("orient2d has one sign at all widths") {
    check_polynomial<detail::exact::orient2d_polynomial>();
    check_polynomial<detail::exact::normal_polynomial>();
}
TEST_CASE("orient3d has one sign at all widths") {
    check_polynomial<detail::exact::orient3d_polynomial>();
}
TEST_CASE("comparisons have one sign at all widths") {
    check_polynomial<detail::exact::compare_along_polynomial>();
    check_polynomial<detail::exact::compare_distance_polynomial>();
}
TEST_CASE("polynomials of normals have one sign at all widths") {
    check_polynomial<detail::exact::normal_dot_polynomial>();
    check_polynomial<detail::exact::normal_turn_polynomial>();
    check_polynomial<detail::exact::normal_determinant_polynomial>();
}

}  // namespace
