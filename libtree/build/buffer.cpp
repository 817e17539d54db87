#include <treeform/tree/detail/buffer.hpp>

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace treeform::detail {

void* allocate_buffer(std::size_t bytes) {
    constexpr std::size_t cache_line = 64;
    constexpr std::size_t huge_page = std::size_t{1} << 21;
    const std::size_t alignment = bytes >= 2 * huge_page ? huge_page : cache_line;
    const std::size_t size = bytes == 0 ? cache_line : bytes;
    void* memory = nullptr;
    if (::posix_memalign(&memory, alignment, size) != 0) throw std::bad_alloc();
#ifdef __linux__
    // Only a hint; only whole huge pages, so that the rest of the last one is not made resident.
    if (alignment == huge_page)
        (void)::madvise(memory, size / huge_page * huge_page, MADV_HUGEPAGE);
#endif
    return memory;
}

void free_buffer(void* memory) { std::free(memory); }

}  // namespace treeform::detail
