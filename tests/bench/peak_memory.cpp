#include "bench/measure.hpp"
#include <treeform/tree/parallel.hpp>

#include <malloc.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace treeform::bench {
namespace {

/// The peak of this address space. getrusage would tell that of the parent too: a child inherits
/// the largest resident set of what it was forked from.
std::optional<double> peak_kb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kb = 0; word == "VmHWM:" && status >> kb) return kb;
    return {};
}

void forget_peak() {
    malloc_trim(0);  // what preparing left behind in the heap is no need of the run
    std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace

std::optional<double> own_peak_mb(const contestant& contestant) {
    const job job = contestant.prepare();
    forget_peak();
    const thread_scope scope(contestant.threads);
    job.run();
    const std::optional<double> kb = peak_kb();
    job.discard();
    return kb ? std::optional(*kb * 1024 / 1e6) : std::nullopt;
}

std::optional<std::string> text_printed_by(const std::vector<std::string>& command) {
    int ends[2];
    if (::pipe(ends) != 0) return {};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const bool started =
        ::posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    std::string text;
    char block[256];
    for (ssize_t got = 0; started && (got = ::read(ends[0], block, sizeof block)) > 0;)
        text.append(block, static_cast<std::size_t>(got));
    ::close(ends[0]);
    int status = 0;
    if (!started || ::waitpid(child, &status, 0) != child || status != 0) return {};
    return text;
}

std::optional<double> number_printed_by(const std::vector<std::string>& command) {
    const std::string text = text_printed_by(command).value_or("");
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return end == text.c_str() ? std::nullopt : std::optional(value);
}

}  // namespace treeform::bench
