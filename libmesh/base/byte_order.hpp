#pragma once
/// \file
/// Values in the byte order of a file.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace treeform::detail::base {

/// The value of type T whose bytes start at `from`, in the order `order`.
template <class T, std::endian order>
[[nodiscard]] T load(const char* from) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if constexpr (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

/// Writes the bytes of `value` to `to` in the order `order`.
template <std::endian order, class T>
void store(char* to, T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    std::memcpy(to, bytes.data(), sizeof(T));
}

}  // namespace treeform::detail::base
