#pragma once
/// \file
/// From the type of a column to a C++ type.

#include <libmesh/attributes.hpp>

#include <cstdint>

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
        case scalar_type::float32:
            return f(float{});
        case scalar_type::float64:
            break;
    }
    return f(double{});
}

}  // namespace tf::detail
