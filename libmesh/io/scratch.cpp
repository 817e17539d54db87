#include <libmesh/io/scratch.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <system_error>

namespace treeform::detail::io {

namespace {

[[noreturn]] void fail(std::string_view name, int error) {
    throw io_error(std::string(name) + ": scratch file: " + std::generic_category().message(error));
}

}  // namespace

int open_nameless_file(std::string_view name, const std::filesystem::path& folder) {
#ifdef O_TMPFILE
    // /tmp may itself be memory.
    for (const char* const place : {folder.c_str(), "/var/tmp", "/tmp"}) {
        const int fd = ::open(place, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        if (fd >= 0) return fd;
    }
#endif
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
    const int fd = file ? ::fcntl(::fileno(file.get()), F_DUPFD_CLOEXEC, 3) : -1;
    if (fd < 0) fail(name, errno);
    return fd;
}

scratch::scratch(std::size_t size, scratch_place place, std::string_view name,
                 const std::filesystem::path& folder)
    : size_(size), place_(place) {
    if (size == 0) return;
    void* map = MAP_FAILED;
    if (place == scratch_place::memory) {
        map = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (map == MAP_FAILED) throw std::bad_alloc();
    } else {
        const int fd = open_nameless_file(name, folder);
        // All the room at once: a full disk would otherwise show as a signal.
        const int error = ::posix_fallocate(fd, 0, static_cast<off_t>(size));
        if (error == 0) map = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
        const int mapped = errno;
        ::close(fd);
        if (error != 0 || map == MAP_FAILED) fail(name, error != 0 ? error : mapped);
    }
    data_ = static_cast<char*>(map);
}

scratch::~scratch() {
    if (data_ != nullptr) ::munmap(data_, size_);
}

void scratch::release_memory() const {
    if (place_ == scratch_place::file && size_ > 0) ::madvise(data_, size_, MADV_DONTNEED);
}

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
