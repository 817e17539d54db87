#pragma once
/// \file
/// From the type of a column to a C++ type.

#include <libmesh/attributes.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace tf::detail {

/// Calls f with a value of the C++ type that `type` stands for.
template <class F>
decltype(auto) with_type(scalar_type type, F&& f) {
    switch (type) {
        case scalar_type::int8:
            return f(std::int8_t{});
        case scalar_type::uint8:
            return f(std::uint8_t{});
        case scalar_type::int16:
            return f(std::int16_t{});
        case scalar_type::uint16:
            return f(std::uint16_t{});
        case scalar_type::int32:
            return f(std::int32_t{});
        case scalar_type::uint32:
            return f(std::uint32_t{});
        case scalar_type::int64:
            return f(std::int64_t{});
        case scalar_type::uint64:
            return f(std::uint64_t{});
        case scalar_type::float32:
            return f(float{});
        case scalar_type::float64:
            break;
    }
    return f(double{});
}

/// True when x is a value of the integer type T. The limits are powers of two, which doubles hold.
template <class T>
requires std::is_integral_v<T>
[[nodiscard]] bool is_value_of(double x) {
    constexpr double beyond = 2.0 * static_cast<double>(std::numeric_limits<T>::max() / 2 + 1);
    constexpr auto least = static_cast<double>(std::numeric_limits<T>::min());
    return x >= least && x < beyond && x == std::floor(x);
}

}  // namespace tf::detail
