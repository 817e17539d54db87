#pragma once
/// \file
/// Hashes of coordinates, equal for equal coordinates.

#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstdint>

namespace treeform::detail::weld {

/// The bits of x, with -0 as +0: equal if and only if the coordinates are. Independent of processor
/// modes: a comparison that flushes denormals would take different ones for equal.
[[nodiscard]] inline std::uint64_t bits_of(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return bits << 1 == 0 ? 0 : bits;
}

/// Multiplication by an odd number propagates low bits up, and the shift propagates high bits down:
/// coordinates converted from floats differ in their high bits only. Each step is a bijection.
[[nodiscard]] inline std::uint32_t hash_of(const point3& p, std::uint32_t label = 0) {
    std::uint64_t h = 0x243f6a8885a308d3 + label;
    for (const double x : {p.x, p.y, p.z}) {
        h = (h + bits_of(x)) * 0x9e3779b97f4a7c15;
        h ^= h >> 32;
    }
    return static_cast<std::uint32_t>((h * 0xd1342543de82ef95) >> 32);
}

}  // namespace treeform::detail::weld
