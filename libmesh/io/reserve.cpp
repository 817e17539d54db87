#include <libmesh/io/reserve.hpp>

#include <sys/mman.h>

#include <cstdint>

namespace treeform::detail::io {

void prefer_large_pages(void* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    constexpr std::uintptr_t large = std::uintptr_t{2} << 20;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + large - 1) / large * large;
    const std::uintptr_t last = (begin + bytes) / large * large;
    // Only pages that lie wholly in the block: its neighbors belong to others.
    if (first < last)
        ::madvise(static_cast<char*>(memory) + (first - begin), last - first, MADV_HUGEPAGE);
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace treeform::detail::io
