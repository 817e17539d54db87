/// \file
/// The constants that the filter and the widths rest on, recomputed from the polynomials.

#include <libmesh/exact/exact_place.hpp>
#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/implicit_polynomials.hpp>
#include <libmesh/exact/ray_polynomials.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace {

namespace detail = treeform::detail;

/// Counts the factors (1 + e) on the worst product of an expression.
struct rounding_count {
    int factors;
};
rounding_count operator*(rounding_count a, rounding_count b) { return {a.factors + b.factors + 1}; }
rounding_count operator+(rounding_count a, rounding_count b) {
    return {std::max(a.factors, b.factors) + 1};
}
rounding_count operator-(rounding_count a, rounding_count b) { return a + b; }

/// The same for what underflow loses: how many operations there are.
struct operation_count {
    int operations;
};
operation_count operator*(operation_count a, operation_count b) {
    return {a.operations + b.operations + 1};
}
operation_count operator+(operation_count a, operation_count b) { return a * b; }
operation_count operator-(operation_count a, operation_count b) { return a * b; }

template <class Polynomial, class Count>
auto evaluated(Count difference) {
    detail::exact::points_of<Polynomial, double> points{};
    return Polynomial::value(detail::exact::transform(Polynomial::differences(points),
                                                      [&](double) { return difference; }));
}

int factors_of(rounding_count c) { return c.factors; }
int factors_of(const detail::exact::vector3<rounding_count>& v) {
    return std::max({v.x.factors, v.y.factors, v.z.factors});
}
int factors_of(const detail::exact::vector2<rounding_count>& v) {
    return std::max(v.x.factors, v.y.factors);
}
int factors_of(const detail::exact::quotient_point<rounding_count, rounding_count>& v) {
    return std::max(factors_of(v.over), v.under.factors);
}
int operations_of(operation_count c) { return c.operations; }
int operations_of(const detail::exact::vector3<operation_count>& v) {
    return std::max({v.x.operations, v.y.operations, v.z.operations});
}
int operations_of(const detail::exact::vector2<operation_count>& v) {
    return std::max(v.x.operations, v.y.operations);
}
int operations_of(const detail::exact::quotient_point<operation_count, operation_count>& v) {
    return std::max(operations_of(v.over), v.under.operations);
}

template <class Polynomial>
void check_error_factor() {
    constexpr long double u = 0x1p-52L;
    const int factors = factors_of(evaluated<Polynomial>(rounding_count{1}));
    CHECK(factors == Polynomial::roundings);
    // What the filter compares is rounded too: `factors` times in the permanent, once with c.
    const long double error = std::expm1(factors * std::log1p(u));
    const long double least = (error + u / 2) / std::pow(1 - u, factors + 1.0L);
    CHECK(static_cast<long double>(detail::exact::error_factor<Polynomial>) >= least);
    CHECK(operations_of(evaluated<Polynomial>(operation_count{1})) < 128);
}

TEST_CASE("the filter's constant exceeds the error bound of its polynomial") {
    check_error_factor<detail::exact::orient2d_polynomial>();
    check_error_factor<detail::exact::normal_polynomial>();
    check_error_factor<detail::exact::orient3d_polynomial>();
    check_error_factor<detail::exact::compare_along_polynomial>();
    check_error_factor<detail::exact::compare_distance_polynomial>();
    check_error_factor<detail::exact::normal_dot_polynomial>();
    check_error_factor<detail::exact::normal_cross_polynomial>();
    check_error_factor<detail::exact::normal_turn_polynomial>();
    check_error_factor<detail::exact::normal_determinant_polynomial>();
    check_error_factor<detail::exact::direction_side_polynomial>();
    check_error_factor<detail::exact::line_side_polynomial>();
    check_error_factor<detail::exact::cut_polynomial>();
    check_error_factor<detail::exact::compare_cut_polynomial>();
    check_error_factor<detail::exact::compare_cuts_polynomial>();
    check_error_factor<detail::exact::lines_polynomial>();
    check_error_factor<detail::exact::line_plane_polynomial>();
    check_error_factor<detail::exact::planes_polynomial>();
    check_error_factor<detail::exact::line_normal_polynomial>();
}

TEST_CASE("the guards keep what underflow loses below the slack, and products finite") {
    const auto check = []<int Degree>() {
        const double largest = detail::exact::largest_difference<Degree>;
        CHECK(std::log2(largest) * (Degree - 1) <= 400.0);
        CHECK(std::log2(largest) * Degree + 6 < 1023.0);
    };
    check.operator()<2>();
    check.operator()<3>();
    check.operator()<4>();
    check.operator()<5>();
    check.operator()<6>();
    check.operator()<7>();
    // 2^400 of further factors, 2^-1020 lost an operation, 2^7 operations, coefficients below 2^6
    CHECK(400 - 1020 + 7 + 6 < std::log2(detail::exact::least_permanent) - 52 - 1);
}

/// Bounds a value of some degree in coordinates of m bits: its magnitude is below
/// 2^(degree m + sums). Where it says so, it is kept in `degree` times the limbs of a coordinate.
struct bit_count {
    int degree;
    int sums;
};
/// What a value of `degree` limbs of 3 bits to spare must hold.
bit_count kept(bit_count a) {
    CHECK(a.sums < 3 * a.degree);
    return a;
}
bit_count operator*(bit_count a, bit_count b) {
    return kept({a.degree + b.degree, a.sums + b.sums});
}
bit_count operator+(bit_count a, bit_count b) {
    CHECK(a.degree == b.degree);
    return kept({a.degree, std::max(a.sums, b.sums) + 1});
}
bit_count operator-(bit_count a, bit_count b) { return a + b; }
int sign_of(bit_count) { return 1; }

}  // namespace

template <>
struct tf::detail::exact::one_of<bit_count> {
    static bit_count value() { return {0, 1}; }
};

namespace {

TEST_CASE("no value of a constructed point outgrows the limbs of its degree") {
    using tf::implicit_point;
    using place = detail::exact::places_of<bit_count>::large;
    using origin = implicit_point::origin;
    const bit_count coordinate{1, 0};
    std::array<detail::exact::vector3<bit_count>, 9> points;
    points.fill({coordinate, coordinate, coordinate});
    const auto at = [&](origin kind) {
        return detail::exact::place_of<place>(kind, points.data());
    };
    const std::array places{at(origin::given), at(origin::lines), at(origin::line_plane),
                            at(origin::planes), at(origin::line_normal)};
    for (const place& p : places) {
        CHECK(p.over.x.degree == p.under.degree + 1);
        CHECK(detail::exact::side_of_place(points.data(), p) == 1);
        for (const place& q : places) {
            CHECK(detail::exact::compare_places(0, p, q) == 1);
            for (const place& r : places) CHECK(detail::exact::orient2d_of_places(0, p, q, r) == 1);
        }
    }
    using small = detail::exact::places_of<detail::exact::integer<2>>::small;
    using large = detail::exact::places_of<detail::exact::integer<2>>::large;
    CHECK(places[2].over.x.degree * 2 == sizeof(small{}.over.x) / 8);
    CHECK(places[3].over.x.degree * 2 == sizeof(large{}.over.x) / 8);
    CHECK(places[2].under.degree * 2 == sizeof(small{}.under) / 8);
    CHECK(places[3].under.degree * 2 == sizeof(large{}.under) / 8);
}

/// A small whole number that remembers nothing.
struct whole {
    int value;
};
whole operator*(whole a, whole b) { return {a.value * b.value}; }
whole operator+(whole a, whole b) { return {a.value + b.value}; }
whole operator-(whole a, whole b) { return {a.value - b.value}; }

int magnitude_of(whole a) { return std::abs(a.value); }
int magnitude_of(const detail::exact::vector2<whole>& v) {
    return std::max(magnitude_of(v.x), magnitude_of(v.y));
}
int magnitude_of(const detail::exact::vector3<whole>& v) {
    return std::max({magnitude_of(v.x), magnitude_of(v.y), magnitude_of(v.z)});
}

/// The largest value for differences of `choices` (such as -1 and 1), by trying all.
template <class Polynomial>
int largest_value(const std::vector<int>& choices) {
    detail::exact::points_of<Polynomial, double> points{};
    const auto zeros = Polynomial::differences(points);
    std::size_t components = 0;
    detail::exact::for_each_component(zeros, [&](double) { ++components; });
    std::uint64_t cases = 1;
    for (std::size_t i = 0; i < components; ++i) cases *= choices.size();
    int largest = 0;
    for (std::uint64_t i = 0; i < cases; ++i) {
        std::uint64_t rest = i;
        const auto differences = detail::exact::transform(zeros, [&](double) {
            const whole chosen{choices[rest % choices.size()]};
            rest /= choices.size();
            return chosen;
        });
        largest = std::max(largest, magnitude_of(Polynomial::value(differences)));
    }
    return largest;
}

template <class Polynomial>
void check_growth(const std::vector<int>& choices) {
    const int largest = largest_value<Polynomial>(choices);
    CHECK(largest <= 1 << Polynomial::growth);
    CHECK(2 * largest > 1 << Polynomial::growth);
}

TEST_CASE("no value exceeds its polynomial's growth, and half the growth would be exceeded") {
    const std::vector<int> ends = {-1, 1};  // all but one are linear in each difference
    check_growth<detail::exact::orient2d_polynomial>(ends);
    check_growth<detail::exact::normal_polynomial>(ends);
    check_growth<detail::exact::orient3d_polynomial>(ends);
    check_growth<detail::exact::compare_along_polynomial>(ends);
    check_growth<detail::exact::compare_distance_polynomial>({0, 1});
    check_growth<detail::exact::normal_dot_polynomial>(ends);
    check_growth<detail::exact::normal_cross_polynomial>(ends);
    check_growth<detail::exact::normal_turn_polynomial>(ends);
    check_growth<detail::exact::normal_determinant_polynomial>(ends);
    check_growth<detail::exact::direction_side_polynomial>(ends);
    check_growth<detail::exact::line_side_polynomial>(ends);
    check_growth<detail::exact::cut_polynomial>(ends);
    check_growth<detail::exact::compare_cut_polynomial>(ends);
    check_growth<detail::exact::compare_cuts_polynomial>(ends);
}

TEST_CASE("widths hold what they are said to, and the widest holds all doubles") {
    using detail::exact::most_bits;
    CHECK(most_bits<detail::exact::orient2d_polynomial>(0) == 62);
    CHECK(most_bits<detail::exact::orient3d_polynomial>(0) == 40);
    CHECK(most_bits<detail::exact::orient3d_polynomial>(1) == 62);
    CHECK(most_bits<detail::exact::orient3d_polynomial>(2) == 126);
    CHECK(most_bits<detail::exact::compare_along_polynomial>(1) == 61);
    CHECK(most_bits<detail::exact::normal_determinant_polynomial>(0) == 19);
    CHECK(most_bits<detail::exact::normal_determinant_polynomial>(6) >= 2098);
    CHECK(most_bits<detail::exact::compare_cuts_polynomial>(6) >= 2098);
    CHECK(most_bits<detail::exact::cut_polynomial>(6) >= 2098);
    CHECK(detail::exact::width_class_of<detail::exact::orient3d_polynomial>(40) == 0);
    CHECK(detail::exact::width_class_of<detail::exact::orient3d_polynomial>(41) == 1);
    CHECK(detail::exact::width_class_of<detail::exact::orient3d_polynomial>(63) == 2);
    CHECK(detail::exact::width_class_of<detail::exact::orient3d_polynomial>(2098) == 6);
}

}  // namespace
