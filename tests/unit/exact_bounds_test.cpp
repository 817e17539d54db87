/// \file
/// The constants that the filter and the widths rest on, recomputed from the polynomials.

#include <libmesh/exact/detail/constructed_polynomials.hpp>
#include <libmesh/exact/detail/exact_sign.hpp>
#include <libmesh/exact/detail/filter.hpp>
#include <libmesh/exact/detail/ray_polynomials.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace {

namespace detail = tf::detail;

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
    detail::points_of<Polynomial, double> points{};
    return Polynomial::value(
        detail::transform(Polynomial::differences(points), [&](double) { return difference; }));
}

int factors_of(rounding_count c) { return c.factors; }
int factors_of(const detail::vector3<rounding_count>& v) {
    return std::max({v.x.factors, v.y.factors, v.z.factors});
}
int factors_of(const detail::vector2<rounding_count>& v) {
    return std::max(v.x.factors, v.y.factors);
}
int factors_of(const detail::vector_over<rounding_count>& v) {
    return std::max(factors_of(v.over), v.under.factors);
}
int operations_of(operation_count c) { return c.operations; }
int operations_of(const detail::vector3<operation_count>& v) {
    return std::max({v.x.operations, v.y.operations, v.z.operations});
}
int operations_of(const detail::vector2<operation_count>& v) {
    return std::max(v.x.operations, v.y.operations);
}
int operations_of(const detail::vector_over<operation_count>& v) {
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
    CHECK(static_cast<long double>(detail::error_factor<Polynomial>) >= least);
    CHECK(operations_of(evaluated<Polynomial>(operation_count{1})) < 128);
}

TEST_CASE("the filter's constant exceeds the error bound of its polynomial") {
    check_error_factor<detail::orient2d_polynomial>();
    check_error_factor<detail::normal_polynomial>();
    check_error_factor<detail::orient3d_polynomial>();
    check_error_factor<detail::compare_along_polynomial>();
    check_error_factor<detail::compare_distance_polynomial>();
    check_error_factor<detail::normal_dot_polynomial>();
    check_error_factor<detail::normal_cross_polynomial>();
    check_error_factor<detail::normal_turn_polynomial>();
    check_error_factor<detail::normal_determinant_polynomial>();
    check_error_factor<detail::direction_side_polynomial>();
    check_error_factor<detail::line_side_polynomial>();
    check_error_factor<detail::cut_polynomial>();
    check_error_factor<detail::compare_cut_polynomial>();
    check_error_factor<detail::compare_cuts_polynomial>();
    check_error_factor<detail::lines_polynomial>();
    check_error_factor<detail::line_plane_polynomial>();
    check_error_factor<detail::planes_polynomial>();
}

TEST_CASE("the guards keep what underflow loses below the slack, and products finite") {
    const auto check = []<int Degree>() {
        const double largest = detail::largest_difference<Degree>;
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
    CHECK(400 - 1020 + 7 + 6 < std::log2(detail::least_permanent) - 52 - 1);
}

/// A small whole number that remembers nothing.
struct whole {
    int value;
};
whole operator*(whole a, whole b) { return {a.value * b.value}; }
whole operator+(whole a, whole b) { return {a.value + b.value}; }
whole operator-(whole a, whole b) { return {a.value - b.value}; }

int magnitude_of(whole a) { return std::abs(a.value); }
int magnitude_of(const detail::vector2<whole>& v) {
    return std::max(magnitude_of(v.x), magnitude_of(v.y));
}
int magnitude_of(const detail::vector3<whole>& v) {
    return std::max({magnitude_of(v.x), magnitude_of(v.y), magnitude_of(v.z)});
}

/// The largest value for differences of `choices` (such as -1 and 1), by trying all.
template <class Polynomial>
int largest_value(const std::vector<int>& choices) {
    detail::points_of<Polynomial, double> points{};
    const auto zeros = Polynomial::differences(points);
    std::size_t components = 0;
    detail::for_each_component(zeros, [&](double) { ++components; });
    std::uint64_t cases = 1;
    for (std::size_t i = 0; i < components; ++i) cases *= choices.size();
    int largest = 0;
    for (std::uint64_t i = 0; i < cases; ++i) {
        std::uint64_t rest = i;
        const auto differences = detail::transform(zeros, [&](double) {
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
    check_growth<detail::orient2d_polynomial>(ends);
    check_growth<detail::normal_polynomial>(ends);
    check_growth<detail::orient3d_polynomial>(ends);
    check_growth<detail::compare_along_polynomial>(ends);
    check_growth<detail::compare_distance_polynomial>({0, 1});
    check_growth<detail::normal_dot_polynomial>(ends);
    check_growth<detail::normal_cross_polynomial>(ends);
    check_growth<detail::normal_turn_polynomial>(ends);
    check_growth<detail::normal_determinant_polynomial>(ends);
    check_growth<detail::direction_side_polynomial>(ends);
    check_growth<detail::line_side_polynomial>(ends);
    check_growth<detail::cut_polynomial>(ends);
    check_growth<detail::compare_cut_polynomial>(ends);
    check_growth<detail::compare_cuts_polynomial>(ends);
}

TEST_CASE("widths hold what they are said to, and the widest holds all doubles") {
    using detail::most_bits;
    CHECK(most_bits<detail::orient2d_polynomial>(0) == 62);
    CHECK(most_bits<detail::orient3d_polynomial>(0) == 40);
    CHECK(most_bits<detail::orient3d_polynomial>(1) == 62);
    CHECK(most_bits<detail::orient3d_polynomial>(2) == 126);
    CHECK(most_bits<detail::compare_along_polynomial>(1) == 61);
    CHECK(most_bits<detail::normal_determinant_polynomial>(0) == 19);
    CHECK(most_bits<detail::normal_determinant_polynomial>(6) >= 2098);
    CHECK(most_bits<detail::compare_cuts_polynomial>(6) >= 2098);
    CHECK(most_bits<detail::cut_polynomial>(6) >= 2098);
    CHECK(detail::width_class_of<detail::orient3d_polynomial>(40) == 0);
    CHECK(detail::width_class_of<detail::orient3d_polynomial>(41) == 1);
    CHECK(detail::width_class_of<detail::orient3d_polynomial>(63) == 2);
    CHECK(detail::width_class_of<detail::orient3d_polynomial>(2098) == 6);
}

}  // namespace
