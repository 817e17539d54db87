#pragma once
/// \file
/// Little-endian numbers in point records, and differences of single bytes.

#include <libmesh/base/byte_order.hpp>

#include <bit>
#include <cstdint>

namespace treeform::detail::laz {

[[nodiscard]] inline std::uint16_t get16(const std::uint8_t* p) {
    return base::load<std::uint16_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put16(std::uint8_t* p, std::uint32_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), static_cast<std::uint16_t>(x));
}
[[nodiscard]] inline std::int32_t get32(const std::uint8_t* p) {
    return base::load<std::int32_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put32(std::uint8_t* p, std::int32_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), x);
}
[[nodiscard]] inline std::uint64_t get64(const std::uint8_t* p) {
    return base::load<std::uint64_t, std::endian::little>(reinterpret_cast<const char*>(p));
}
inline void put64(std::uint8_t* p, std::uint64_t x) {
    base::store<std::endian::little>(reinterpret_cast<char*>(p), x);
}

/// 32-bit sums and differences, which wrap around.
[[nodiscard]] inline std::int32_t sum(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
[[nodiscard]] inline std::int32_t difference(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
[[nodiscard]] inline std::int32_t product(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

/// `x` modulo 256.
[[nodiscard]] inline std::uint8_t low_byte(int x) { return static_cast<std::uint8_t>(x); }
[[nodiscard]] inline int clamp_byte(int x) { return x < 0 ? 0 : x > 255 ? 255 : x; }

}  // namespace treeform::detail::laz
