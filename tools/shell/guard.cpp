#include "tools/shell/guard.hpp"

#include "tools/shell/abrupt_exit.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/exit_status.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <thread>

#ifndef __has_feature
#define __has_feature(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TREEFORM_SHADOW_MEMORY 1  // reserves terabytes: no limit on data can be set
#endif

namespace tools {
namespace {

using clock = std::chrono::steady_clock;
constexpr auto grace = std::chrono::milliseconds(1000);
constexpr auto grace_in_team = std::chrono::milliseconds(300);

enum class reason : int { none, interrupt, terminate, hang_up, time, memory };

const char* code_of(reason why) {
    return why == reason::time ? "timeout" : why == reason::memory ? "memory" : "signal";
}

const char* text_of(reason why) {
    switch (why) {
        case reason::none:
            break;
        case reason::interrupt:
            return "stopped by SIGINT";
        case reason::terminate:
            return "stopped by SIGTERM";
        case reason::hang_up:
            return "stopped by SIGHUP";
        case reason::time:
            return "stopped by the time limit (--timeout)";
        case reason::memory:
            break;
    }
    return "stopped";
}

struct own_memory {
    std::uint64_t used = 0;      ///< pages of mapped files are the system's to drop
    std::uint64_t reserved = 0;  ///< as RLIMIT_DATA counts
};

own_memory memory_of_process() {
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    if (file == nullptr) return {};
    unsigned long long resident = 0;
    unsigned long long shared = 0;
    unsigned long long data = 0;
    const int read = std::fscanf(file, "%*u %llu %llu %*u %*u %llu", &resident, &shared, &data);
    std::fclose(file);
    if (read != 3 || shared > resident) return {};
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return {(resident - shared) * page, data * page};
}

/// Reserved for the threads of loops: of each stack, some pages are used.
std::uint64_t memory_of_stacks() {
    constexpr std::uint64_t usual = std::uint64_t{8} << 20;
    rlimit stack{};
    const bool known = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
    return (tf::thread_count() + std::uint64_t{2}) * (known ? stack.rlim_cur : usual);
}

void bound_data(std::uint64_t bytes) {
#ifdef TREEFORM_SHADOW_MEMORY
    static_cast<void>(bytes);
#else
    rlimit bound{};
    if (getrlimit(RLIMIT_DATA, &bound) != 0) return;
    bound.rlim_cur = std::min<rlim_t>(bytes, bound.rlim_cur);
    setrlimit(RLIMIT_DATA, &bound);
#endif
}

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction present {};
        sigaction(signal, nullptr, &present);
        if (present.sa_handler != SIG_IGN) sigaddset(&set, signal);  // nohup stays in force
    }
    return set;
}

namespace fs = std::filesystem;
constexpr std::uint64_t unbounded = std::numeric_limits<std::uint64_t>::max();

/// Numbers by the words ahead of them: "MemFree:  123 kB", "inactive_file 456".
std::map<std::string, std::uint64_t> named_numbers(const fs::path& path) {
    std::map<std::string, std::uint64_t> numbers;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t blank = line.find_first_of(" \t");
        if (blank == std::string::npos) continue;
        std::string name = line.substr(0, blank);
        if (name.ends_with(':')) name.pop_back();
        numbers[name] = std::strtoull(line.c_str() + blank, nullptr, 10);
    }
    return numbers;
}

/// None where there is no such file; "max" is no bound.
std::optional<std::uint64_t> number_in(const fs::path& path) {
    std::ifstream file(path);
    std::string word;
    if (!(file >> word)) return std::nullopt;
    if (word == "max") return unbounded;
    return std::strtoull(word.c_str(), nullptr, 10);
}

std::uint64_t left_of(std::uint64_t all, std::uint64_t used) { return all > used ? all - used : 0; }

/// How one version of control groups names its files.
struct group_files {
    const char* limit;
    const char* usage;
    std::initializer_list<const char*> pages_of_files;  ///< in memory.stat
};
const group_files first_version{
    "memory.limit_in_bytes", "memory.usage_in_bytes", {"total_active_file", "total_inactive_file"}};
const group_files second_version{"memory.max", "memory.current", {"active_file", "inactive_file"}};

std::uint64_t left_in_folder(const fs::path& folder, const group_files& names) {
    const auto limit = number_in(folder / names.limit);
    const auto usage = number_in(folder / names.usage);
    if (!limit || !usage || *limit == unbounded) return unbounded;
    const auto counts = named_numbers(folder / "memory.stat");
    std::uint64_t pages = 0;
    for (const char* const name : names.pages_of_files)
        if (const auto found = counts.find(name); found != counts.end()) pages += found->second;
    return left_of(*limit, left_of(*usage, pages));
}

/// The least that a group from `mount` down to `group` has left. In a container, `group` may be
/// named as from outside, while `mount` is the container's own.
std::uint64_t left_on_the_way(const fs::path& mount, const std::string& group,
                              const group_files& names) {
    fs::path folder = mount;
    std::uint64_t least = left_in_folder(folder, names);
    for (const fs::path& step : fs::path(group).relative_path())
        least = std::min(least, left_in_folder(folder /= step, names));
    return least;
}

/// Lines are "4:cpu,memory:/a/b"; "0::/a/b" in version 2.
std::uint64_t left_in_groups(const fs::path& system) {
    const fs::path mounts = system / "sys/fs/cgroup";
    std::uint64_t least = unbounded;
    std::ifstream file(system / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string kinds = "," + line.substr(first + 1, second - first - 1) + ",";
        const std::string group = line.substr(second + 1);
        if (kinds == ",,")
            for (const fs::path& mount : {mounts, mounts / "unified"})
                least = std::min(least, left_on_the_way(mount, group, second_version));
        else if (kinds.find(",memory,") != std::string::npos)
            least = std::min(least, left_on_the_way(mounts / "memory", group, first_version));
    }
    return least;
}

}  // namespace

struct guard::state {
    limits bounds;
    own_memory before{};  ///< that does not count
    clock::time_point start = clock::now();
    std::atomic<reason> why{reason::none};
    sigset_t signals{};
    sigset_t signals_before{};
    int signal_fd = -1;
    int done_fd = -1;
    std::thread watcher;

    void watch();
    [[nodiscard]] bool is_late() const {
        const std::chrono::duration<double> elapsed = clock::now() - start;
        return bounds.seconds > 0.0 && elapsed.count() > bounds.seconds;
    }
    [[nodiscard]] reason next_reason(bool signalled) const;
    [[nodiscard]] clock::duration time_to_end() const;
    [[nodiscard]] std::string memory_text() const;
    [[nodiscard]] std::string text() const {
        return why == reason::memory ? memory_text() : text_of(why);
    }
};

reason guard::state::next_reason(bool signalled) const {
    if (signalled) {
        signalfd_siginfo info{};
        if (read(signal_fd, &info, sizeof info) == sizeof info) {
            if (info.ssi_signo == SIGINT) return reason::interrupt;
            return info.ssi_signo == SIGHUP ? reason::hang_up : reason::terminate;
        }
    }
    if (is_late()) return reason::time;
    if (bounds.memory > 0 && memory_of_process().used > bounds.memory + before.used)
        return reason::memory;
    return reason::none;
}

/// When the first rank ends, or after a second, mpirun kills all. Who has files to remove is
/// that first one.
clock::duration guard::state::time_to_end() const {
    return bounds.beside_others && has_unfinished() ? grace_in_team : grace;
}

void guard::state::watch() {
    clock::time_point asked{};
    while (true) {
        pollfd files[2] = {{signal_fd, POLLIN, 0}, {done_fd, POLLIN, 0}};
        const bool idle = bounds.seconds == 0.0 && bounds.memory == 0 && why == reason::none;
        if (poll(files, 2, idle ? -1 : 20) < 0) continue;
        if ((files[1].revents & POLLIN) != 0) return;
        const bool signalled = (files[0].revents & POLLIN) != 0;
        const reason next = next_reason(signalled);
        if (why == reason::none) {
            if (next == reason::none) continue;
            why = next;
            asked = clock::now();
        } else if ((signalled && next != reason::none) || clock::now() - asked > time_to_end()) {
            exit_abruptly(stopped, text().c_str());
        }
    }
}

std::string guard::state::memory_text() const {
    if (bounds.memory == 0) return "out of memory";
    if (!bounds.as_free) return "stopped by the memory limit (--memory)";
    return "needs more memory than the " + in_bytes(bounds.memory) +
           " that was free when it started (--memory sets another limit)";
}

guard::guard(limits bounds) : state_(std::make_unique<state>()) {
    state_->bounds = bounds;
    if (bounds.beside_others) state_->before = memory_of_process();
    if (bounds.memory > 0) bound_data(bounds.memory + state_->before.reserved + memory_of_stacks());
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an output error like any other
    std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that may not get as large
    state_->signals = watched_signals();
    pthread_sigmask(SIG_BLOCK, &state_->signals, &state_->signals_before);
    state_->signal_fd = signalfd(-1, &state_->signals, SFD_CLOEXEC | SFD_NONBLOCK);
    state_->done_fd = eventfd(0, EFD_CLOEXEC);
    set_words_for_memory(state_->memory_text());
    state_->watcher = std::thread([s = state_.get()] { s->watch(); });
}

guard::~guard() {
    const std::uint64_t one = 1;
    if (write(state_->done_fd, &one, sizeof one) != sizeof one) std::_Exit(bug);
    state_->watcher.join();
    close(state_->signal_fd);
    close(state_->done_fd);
    pthread_sigmask(SIG_SETMASK, &state_->signals_before, nullptr);
}

bool guard::stop_requested() const { return state_->why != reason::none; }

void guard::check() const {
    // The watcher looks every 20 ms; work that is done sooner has to keep its time, too.
    reason why = reason::none;
    if (state_->is_late()) state_->why.compare_exchange_strong(why, reason::time);
    why = state_->why;
    if (why != reason::none) throw failure(stopped, code_of(why), state_->text());
}

std::string guard::want_of_memory() const { return state_->memory_text(); }

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t free_memory(const fs::path& system) {
    auto machine = named_numbers(system / "proc/meminfo");
    if (!machine.contains("MemAvailable")) return 0;
    const std::uint64_t available = (machine["MemAvailable"] + machine["SwapFree"]) * 1024;
    return std::min(available, left_in_groups(system));
}

std::uint64_t usable_memory() {
    std::uint64_t bytes = free_memory();
    bytes -= bytes / 32;
    if (bytes == 0) return 0;
    for (const auto which : {RLIMIT_AS, RLIMIT_DATA}) {
        rlimit own{};
        if (getrlimit(which, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
            bytes = std::min<std::uint64_t>(bytes, own.rlim_cur);
    }
    return bytes;
}

}  // namespace tools
