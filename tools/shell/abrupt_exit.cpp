#include "tools/shell/abrupt_exit.hpp"

#include "tools/shell/exit_status.hpp"

#include <cxxabi.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <typeinfo>
#include <utility>

namespace tools {
namespace {

struct remembered_path {
    enum : int { free, filling, there };
    std::atomic<int> is{free};
    std::array<char, 4096> name{};
};
std::array<remembered_path, 256> paths;

std::array<char, 256> memory_words{"out of memory"};
std::atomic<bool> memory_ran_out{false};
std::atomic<bool> ends{false};
/// Given back when memory first runs out, so that it can be said, and reported, in full.
std::atomic<void*> reserve{nullptr};
constexpr std::size_t reserve_size = std::size_t{1} << 18;

/// Removes a file, or a folder and all that is in it.
void remove_all_at(int folder, const char* name, int depth) {
    if (unlinkat(folder, name, 0) == 0 || errno == ENOENT) return;
    constexpr int deepest = 16, most_rounds = 1000;
    const int fd = openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0 || depth > deepest) return;
    alignas(dirent64) std::array<char, 4096> entries;
    for (int round = 0; round < most_rounds; ++round) {  // others may still be writing there
        bool found = false;
        lseek(fd, 0, SEEK_SET);
        for (long size = 0;
             (size = syscall(SYS_getdents64, fd, entries.data(), entries.size())) > 0;)
            for (long at = 0; at < size;) {
                const auto* const entry = reinterpret_cast<const dirent64*>(entries.data() + at);
                at += entry->d_reclen;
                const std::string_view child = entry->d_name;
                if (child == "." || child == "..") continue;
                found = true;
                remove_all_at(fd, entry->d_name, depth + 1);
            }
        if (!found) break;
    }
    close(fd);
    unlinkat(folder, name, AT_REMOVEDIR);
}

void say(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void on_fault(int) { exit_abruptly(stopped, memory_words.data()); }

/// From here on, what crashes has not looked whether it got its memory (nlohmann/json takes apart
/// objects that it could not make).
[[noreturn]] void on_memory() {
    if (!memory_ran_out.exchange(true)) {
        std::free(reserve.exchange(nullptr));
        for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) std::signal(signal, on_fault);
    }
    throw std::bad_alloc();
}

[[noreturn]] void on_terminate() {
    const std::type_info* const type = abi::__cxa_current_exception_type();
    const bool is_memory = type == nullptr ? memory_ran_out.load()
                                           : *type == typeid(std::bad_alloc) ||
                                                 *type == typeid(std::bad_array_new_length);
    exit_abruptly(is_memory ? stopped : bug, is_memory ? memory_words.data() : "internal error");
}

void start(int, char**, char**) {
    reserve = std::malloc(reserve_size);
    std::set_new_handler(on_memory);
    std::set_terminate(on_terminate);
}

/// Before main, and before what libraries build for themselves.
[[gnu::section(".preinit_array"), gnu::used]] void (*const at_start)(int, char**, char**) = start;

}  // namespace

void unfinished_path::remember() {
    for (remembered_path& slot : paths) {
        int is = remembered_path::free;
        if (path_.size() >= slot.name.size()) return;
        if (!slot.is.compare_exchange_strong(is, remembered_path::filling)) continue;
        std::memcpy(slot.name.data(), path_.c_str(), path_.size() + 1);
        slot.is = remembered_path::there;
        return;
    }
}

void unfinished_path::set(std::string path) {
    path_ = std::move(path);
    remember();
}

bool unfinished_path::make_folder(std::string name) {
    if (mkdtemp(name.data()) == nullptr) return false;
    path_ = std::move(name);  // allocates nothing, so that it is remembered
    remember();
    return true;
}

unfinished_path::~unfinished_path() {
    if (path_.empty()) return;
    remove_all_at(AT_FDCWD, path_.c_str(), 0);
    for (remembered_path& slot : paths)
        if (slot.is == remembered_path::there && path_ == slot.name.data())
            slot.is = remembered_path::free;
}

bool has_unfinished() {
    for (const remembered_path& slot : paths)
        if (slot.is == remembered_path::there) return true;
    return false;
}

void set_words_for_memory(const std::string& words) {
    memory_words = {};
    words.copy(memory_words.data(), memory_words.size() - 1);
}

void exit_abruptly(int status, const char* words) {
    if (ends.exchange(true))
        for (;;) pause();
    for (const remembered_path& slot : paths)
        if (slot.is == remembered_path::there) remove_all_at(AT_FDCWD, slot.name.data(), 0);
    if (*words == '\0') std::_Exit(status);
    for (const std::string_view part :
         {std::string_view(program_invocation_short_name), std::string_view(": error: "),
          std::string_view(words), std::string_view("\n")})
        say(part);
    std::_Exit(status);
}

}  // namespace tools
