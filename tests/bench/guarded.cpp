#include "bench/guarded.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <new>
#include <stdexcept>
#include <thread>

namespace treeform::bench {
namespace {

[[noreturn]] void work_and_exit(const std::function<bool()>& work) {
    const struct rlimit no_core { 0, 0 };
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (!std::freopen("/dev/null", "w", stderr)) ::_exit(1);
    try {
        ::_exit(work() ? 0 : 1);
    } catch (...) {
        ::_exit(1);
    }
}

}  // namespace

std::string_view name_of(ending ending) {
    switch (ending) {
        case ending::done:
            return "done";
        case ending::failed:
            return "refused";
        case ending::crashed:
            return "crashed";
        case ending::late:
            break;
    }
    return "too late";
}

ending ending_of(const std::function<bool()>& work, double seconds) {
    std::fflush(nullptr);
    const ::pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process to try in");
    if (child == 0) work_and_exit(work);
    using clock = std::chrono::steady_clock;
    const auto until = clock::now() + std::chrono::duration<double>(seconds);
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (clock::now() > until) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            return ending::late;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (WIFSIGNALED(status)) return ending::crashed;
    return WEXITSTATUS(status) == 0 ? ending::done : ending::failed;
}

std::vector<signed char> values_of(std::size_t count,
                                   const std::function<signed char(std::size_t)>& work,
                                   signed char lost) {
    struct page {
        std::atomic<std::size_t> done;
        signed char values[1];
    };
    const std::size_t bytes = sizeof(page) + count;
    void* const memory =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
    page& shared = *new (memory) page{};
    signed char* const values = shared.values;
    while (shared.done < count) {
        const ending how = ending_of(
            [&] {
                for (std::size_t i = shared.done; i < count; ++i) {
                    ::alarm(1);
                    values[i] = work(i);
                    shared.done = i + 1;
                }
                return true;
            },
            3600);
        if (how != ending::done) values[shared.done++] = lost;
    }
    std::vector<signed char> result(values, values + count);
    ::munmap(memory, bytes);
    return result;
}

}  // namespace treeform::bench
