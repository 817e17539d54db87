#pragma once
/// \file
/// Room for large arrays in large pages.

#include <cstddef>
#include <vector>

namespace treeform::detail::io {

/// Says to the system that `bytes` bytes at `memory` will be filled soon, so that it may hand them
/// out in large pages. A hint: nothing depends on it but time (filling fresh small pages takes
/// several times as long as reading a binary file that is in memory).
void prefer_large_pages(void* memory, std::size_t bytes);

/// v.reserve(count), in large pages where that pays.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t count) {
    v.reserve(count);
    if (v.capacity() * sizeof(T) >= std::size_t{8} << 20)
        prefer_large_pages(v.data(), v.capacity() * sizeof(T));
}

}  // namespace treeform::detail::io
