// To be preloaded, or linked (`fail_allocations`): allocations fail from the TREEFORM_FAIL_AT-th
// on, counted from 1, or that one alone where TREEFORM_FAIL_ONCE is set. At the end, their number
// goes to the file TREEFORM_COUNT_TO.

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<long> count{0};
std::atomic<long> fail_at{0};
std::atomic<bool> once{false};

[[gnu::constructor]] void start() {
    const char* const at = std::getenv("TREEFORM_FAIL_AT");
    fail_at = at != nullptr ? std::atol(at) : 0;
    once = std::getenv("TREEFORM_FAIL_ONCE") != nullptr;
}

[[gnu::destructor]] void say_count() {
    const char* const path = std::getenv("TREEFORM_COUNT_TO");
    if (path == nullptr) return;
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%ld\n", count.load());
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || write(file, text, static_cast<std::size_t>(size)) != size) _exit(99);
    close(file);
}

/// While a library is opened, as TBB opens its allocator when it is first used: glibc itself faults
/// where memory runs out then.
[[gnu::tls_model("initial-exec")]] thread_local bool is_opening = false;

bool fails() {
    const long number = ++count;
    const long at = fail_at;
    if (at == 0 || is_opening || (once ? number != at : number < at)) return false;
    errno = ENOMEM;
    return true;
}

}  // namespace

extern "C" {

/// From now on the n-th fails, alone or with all that follow; for 0 none does.
void fail_allocations(long n, int alone) {
    fail_at = 0;
    once = alone != 0;
    fail_at = n > 0 ? count + n : 0;
}

void* dlopen(const char* path, int mode) {
    is_opening = true;
    const auto open = reinterpret_cast<void* (*)(const char*, int)>(dlsym(RTLD_NEXT, "dlopen"));
    void* const library = open(path, mode);
    is_opening = false;
    return library;
}

void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t number, std::size_t size) {
    return fails() ? nullptr : __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
    return fails() ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return fails() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    if (fails()) return ENOMEM;
    *memory = __libc_memalign(alignment, size);
    return *memory != nullptr ? 0 : ENOMEM;
}
}
