#pragma once
/// \file
/// Creates large vectors in parallel.

#include <libmesh/base/parallel_invoke.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::base {

/// Page-faults `memory`, which takes several times as long as writing zeros.
/// \pre nothing is in it yet
inline void map_pages(std::span<std::byte> memory) {
    constexpr std::size_t page = 4096, pages_a_chunk = 32;
    for_chunks(chunk_count(memory.size(), page), pages_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t p = begin; p < end; ++p)
                       *static_cast<volatile std::byte*>(&memory[p * page]) = std::byte{0};
               });
}

/// Resizes `vectors` of plain values in parallel.
template <class... Vectors>
void resize_all(std::size_t count, Vectors&... vectors) {
    const auto resize = [count](auto& vector) {
        if (count > vector.size()) {
            vector.reserve(count);
            map_pages({reinterpret_cast<std::byte*>(vector.data() + vector.size()),
                       reinterpret_cast<std::byte*>(vector.data() + count)});
        }
        vector.resize(count);
    };
    parallel_invoke([&] { resize(vectors); }...);
}

/// The numbers 0, 1, 2, ...
[[nodiscard]] inline std::vector<std::uint32_t> numbers_below(std::size_t count) {
    std::vector<std::uint32_t> numbers;
    resize_all(count, numbers);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    });
    return numbers;
}

/// A copy of the elements of `from`.
template <class T>
[[nodiscard]] std::vector<T> copied(std::span<const T> from) {
    std::vector<T> copy;
    resize_all(from.size(), copy);
    for_chunks(from.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::copy(from.data() + begin, from.data() + end, copy.data() + begin);
    });
    return copy;
}

}  // namespace treeform::detail::base
