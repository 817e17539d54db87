#include "tools/shell/team.hpp"

#include "tools/mpi/team_calls.hpp"
#include "tools/shell/exit_status.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tools {
namespace {

const char* const plug_in = "treeform-mpi.so";

/// By what mpirun of Open MPI, or another launcher by way of PMIx, tells its processes.
bool is_started_by_mpi() {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    return size != nullptr ? std::string_view(size) != "1" : std::getenv("PMIX_RANK") != nullptr;
}

/// Signals that ask for an end are not for threads of MPI: while it lives, none is given to those
/// that are made.
class signals_held {
  public:
    signals_held() {
        sigset_t ends;
        sigemptyset(&ends);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
        pthread_sigmask(SIG_BLOCK, &ends, &before_);
    }
    ~signals_held() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    signals_held(const signals_held&) = delete;
    signals_held& operator=(const signals_held&) = delete;

  private:
    sigset_t before_{};
};

const team_calls* join() {
#if TREEFORM_STATIC_TOOLS
    return nullptr;
#else
    const signals_held held;
    // Stays loaded: MPI has threads of its own.
    void* const library = ::dlopen(plug_in, RTLD_NOW | RTLD_GLOBAL);
    void* const found = library == nullptr ? nullptr : ::dlsym(library, "treeform_communicator");
    if (found == nullptr) return nullptr;
    return reinterpret_cast<const team_calls* (*)()>(found)();
#endif
}

/// Why `join` gave nothing.
const char* why_not_joined() {
#if TREEFORM_STATIC_TOOLS
    return "this is a static build";
#else
    const char* const why = ::dlerror();
    return why == nullptr ? "MPI cannot be started" : why;
#endif
}

/// Says why there is no team, and what to do about it.
void say_why_alone(const std::string& why) {
    const bool lacks_plug_in = why.find(plug_in) != why.npos && why.find("No such") != why.npos;
    std::fprintf(stderr, "error: started by mpirun, but without %s: %s\n", plug_in,
                 lacks_plug_in
                     ? "install the Debian package libopenmpi-dev, then build it by `cmake "
                       "build/release && cmake --build build/release --target "
                       "treeform_mpi`, or install treeform again"
                     : why.c_str());
}

/// Returns what standard error was.
std::FILE* be_silent() {
    std::FILE* const heard = ::fdopen(::dup(STDERR_FILENO), "w");
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (const int output : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, output);
    return heard;
}

/// Others may be at work for long before they listen.
void end_later(const team_member& me, int status, std::FILE* heard) {
    std::thread([rank = me.communicator.rank, error = me.error, status, heard] {
        std::this_thread::sleep_for(std::chrono::seconds(5));
        if (rank > 0 && heard != nullptr) {
            std::fprintf(heard, "error: %s\n", error.c_str());
            std::fflush(heard);
        }
        std::_Exit(status);
    }).detach();
}

}  // namespace

int run_in_team(const std::function<int(team_member&)>& tool) {
    team_member me;
    if (!is_started_by_mpi()) return tool(me);
    const team_calls* const calls = join();
    if (calls == nullptr) {
        say_why_alone(why_not_joined());
        return stopped;
    }
    const bool leads = calls->rank == 0;
    std::FILE* const heard = leads ? stderr : be_silent();
    bool all_end = false;
    me.communicator = {calls->rank, calls->size, [&](const std::string& sent) {
                           std::vector<std::string> all = calls->exchange(sent + '\0');
                           for (std::string& one : all) {
                               const auto status = static_cast<exit_status>(one.back());
                               one.pop_back();
                               if (status == done) continue;
                               all_end = true;
                               throw failure(status, "process", one);
                           }
                           return all;
                       }};
    int status = tool(me);
    if (!all_end) {
        if (status > found) end_later(me, status, heard);
        const int failed = status > found ? status : 0;
        for (const std::string& one : calls->exchange(me.error + static_cast<char>(failed)))
            if (one.back() != 0 && failed == 0 && leads) {
                status = one.back();
                std::fprintf(stderr, "error: %s\n", one.substr(0, one.size() - 1).c_str());
                break;
            }
    }
    calls->leave();
    return leads ? status : 0;
}

}  // namespace tools
