#include "bench/span_places.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string_view>

namespace treeform::bench {
namespace {

/// "gather" and "arrange_faces.cpp:132", innermost first; what was inlined has several.
struct call {
    std::string function, line;
};
using names = std::map<std::uintptr_t, std::vector<call>>;

/// In the program's file; 0 for what is not in it, such as the C library.
std::uintptr_t address_of(void* called) {
    static const int here = 0;
    Dl_info own{}, info{};
    if (::dladdr(&here, &own) == 0 || ::dladdr(called, &info) == 0) return 0;
    if (info.dli_fbase != own.dli_fbase) return 0;
    // The call, not what comes after it.
    return reinterpret_cast<std::uintptr_t>(called) - 1 -
           reinterpret_cast<std::uintptr_t>(own.dli_fbase);
}

/// Without arguments, namespaces and what is within a template's brackets.
std::string short_name(const std::string& function) {
    std::string name = function.substr(0, function.find('('));
    name = name.substr(0, name.find('<'));
    const std::size_t colon = name.rfind("::");
    return colon == std::string::npos ? name : name.substr(colon + 2);
}

void ask(const std::filesystem::path& program, names& known) {
    const std::filesystem::path list =
        std::filesystem::temp_directory_path() / ("span_" + std::to_string(::getpid()));
    {
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(list.c_str(), "w"),
                                                                   &std::fclose);
        if (!file) return;
        for (const auto& [address, calls] : known)
            std::fprintf(file.get(), "0x%llx\n", static_cast<unsigned long long>(address));
    }
    const std::string command =
        "addr2line -aifCe '" + program.string() + "' < '" + list.string() + "' 2>/dev/null";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> answer(::popen(command.c_str(), "r"),
                                                                 &::pclose);
    std::vector<call>* calls = nullptr;
    std::array<char, 1 << 16> text{};
    while (answer && std::fgets(text.data(), text.size(), answer.get()) != nullptr) {
        std::string line(text.data());
        line.erase(line.find_last_not_of('\n') + 1);
        if (line.starts_with("0x")) {
            calls = &known[std::stoull(line, nullptr, 16)];
        } else if (calls != nullptr && std::fgets(text.data(), text.size(), answer.get())) {
            const std::string place(text.data(),
                                    std::string_view(text.data()).find_first_of(" \n"));
            const bool is_ours = place.find("/libmesh/") != std::string::npos ||
                                 place.find("/libtree/") != std::string::npos;
            if (is_ours) calls->push_back({short_name(line), place.substr(place.rfind('/') + 1)});
        }
    }
    std::filesystem::remove(list);
}

std::vector<span_place> first_of(const std::map<std::string, std::size_t>& counts,
                                 std::size_t most) {
    std::vector<span_place> places;
    for (const auto& [calls, count] : counts) places.push_back({count, calls});
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& x, const auto& y) { return x.samples > y.samples; });
    if (places.size() > most) places.resize(most);
    return places;
}

}  // namespace

std::vector<span_place> places_of(std::span<const std::vector<void*>> samples, std::size_t most) {
    constexpr std::size_t callers = 5;
    names known;
    for (const auto& calls : samples)
        for (void* called : calls)
            if (const std::uintptr_t address = address_of(called); address != 0) known[address];
    ask(std::filesystem::read_symlink("/proc/self/exe"), known);
    std::map<std::string, std::size_t> within, at;
    for (const auto& calls : samples) {
        std::string place;
        std::set<std::string> lines;
        std::size_t depth = 0;
        for (void* called : calls)
            for (const auto& [function, line] : known[address_of(called)]) {  // of 0: none
                if (depth++ < callers) place += (depth == 1 ? function + " " : " < ") + line;
                lines.insert(line);
            }
        ++at[place];
        for (const std::string& line : lines) ++within[line];
    }
    std::vector<span_place> places = first_of(within, most);
    for (span_place& place : places) place.calls = "within " + place.calls;
    for (span_place& place : first_of(at, most)) places.push_back(std::move(place));
    return places;
}

}  // namespace treeform::bench
