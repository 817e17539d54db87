#include "tools/tiles/team.hpp"

#include "tools/common/exit_status.hpp"
#include "tools/mpi/team_calls.hpp"

#include <dlfcn.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace tools {
namespace {

const char* const plug_in = "treeform-mpi.so";

/// By what mpirun of Open MPI, or another launcher by way of PMIx, tells its processes.
bool is_started_by_mpi() {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    return size != nullptr ? std::string_view(size) != "1" : std::getenv("PMIX_RANK") != nullptr;
}

const team_calls* join() {
    // Stays loaded: MPI has threads of its own.
    void* const library = ::dlopen(plug_in, RTLD_NOW | RTLD_GLOBAL);
    void* const found = library == nullptr ? nullptr : ::dlsym(library, "treeform_team");
    if (found == nullptr) return nullptr;
    return reinterpret_cast<const team_calls* (*)()>(found)();
}

}  // namespace

int run_in_team(const std::function<int(const tf::weld_team&)>& tool) {
    if (!is_started_by_mpi()) return tool({});
    const team_calls* const calls = join();
    if (calls == nullptr) {
        const char* const why = ::dlerror();
        std::fprintf(stderr, "error: started by mpirun, but without %s: %s\n", plug_in,
                     why == nullptr ? "MPI cannot be started" : why);
        return stopped;
    }
    const int status = tool({calls->rank, calls->size, calls->exchange});
    // 1 is an answer, which the first one gives for all.
    if (status > 1) calls->abort(status);
    calls->leave();
    return calls->rank == 0 ? status : 0;
}

void let_first_speak(const tf::weld_team& team) {
    if (team.rank > 0) std::this_thread::sleep_for(std::chrono::seconds(2));
}

}  // namespace tools
