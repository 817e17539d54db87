#pragma once
/// \file
/// Coordinates as bits, of which equal ones are equal.

#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstdint>

namespace treeform::detail::weld {

/// Equal coordinates have equal bits once -0 is made +0, on which no processor mode has a say: one
/// that flushes denormals would take distinct ones for equal.
[[nodiscard]] inline std::uint64_t bits_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return bits << 1 == 0 ? 0 : bits;
}

/// A product by an odd number carries low bits up, the shift carries high ones down: coordinates
/// that were floats differ in their high bits only. Each step is a bijection of what came before.
[[nodiscard]] inline std::uint32_t hash_of(const point3& p, std::uint32_t label = 0) {
    std::uint64_t h = 0x243f6a8885a308d3 + label;
    for (const double x : {p.x, p.y, p.z}) {
        h = (h + bits_of(x)) * 0x9e3779b97f4a7c15;
        h ^= h >> 32;
    }
    return static_cast<std::uint32_t>((h * 0xd1342543de82ef95) >> 32);
}

}  // namespace treeform::detail::weld
