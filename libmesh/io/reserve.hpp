#pragma once
/// \file
/// Reserves memory in large pages.

#include <cstddef>
#include <vector>

namespace treeform::detail::io {

/// Advises the system to back `bytes` bytes at `memory`, which will be filled soon, by large pages.
/// A hint that only affects time: page-faulting small pages takes several times as long as reading
/// a cached binary file.
void prefer_large_pages(void* memory, std::size_t bytes);

/// v.reserve(count), in large pages if that pays off.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t count) {
    v.reserve(count);
    if (v.capacity() * sizeof(T) >= std::size_t{8} << 20)
        prefer_large_pages(v.data(), v.capacity() * sizeof(T));
}

}  // namespace treeform::detail::io
