#include "tools/shell/free_memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace tools {
namespace {

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
