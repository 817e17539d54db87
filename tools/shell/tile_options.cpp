#include "tools/shell/tile_options.hpp"

#include "tools/mpi/team_calls.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/parse_value.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
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

namespace fs = std::filesystem;

fs::path tile_options::folder_for(const job& work, const std::string& tool,
                                  std::initializer_list<fs::path> outputs) const {
    if (!folder.empty()) return folder;
    fs::path beside;
    for (const fs::path& output : outputs)
        if (beside.empty() && output != "-") beside = output;
    if (beside.empty())
        beside = fs::temp_directory_path() /
                 (work.path == "-" ? fs::path("standard_input") : fs::path(work.path).filename());
    return beside.string() + "." + tool + "-tiles";
}

std::function<void()> tile_options::step_done() const {
    if (stop_at == 0) return {};
    return [left = stop_at]() mutable {
        if (--left == 0) static_cast<void>(std::raise(SIGKILL));
    };
}

void add_tile_options(command_line& line, tile_options& target, const std::string& heading,
                      const std::string& per_tile) {
    line.group(heading);
    line.option({"--work", "DIR",
                 "folder for the tiles; kept if the run is stopped, so\n"
                 "that the same command can resume",
                 "beside the output, or in /tmp"},
                [&target](std::string_view text) { target.folder = text; });
    line.option({.names = per_tile, .value = "N"}, [&target, per_tile](std::string_view text) {
        target.per_tile = parse_count(per_tile, text);
    });
    line.option({.names = "--stop-at", .value = "STEP"}, [&target](std::string_view text) {
        target.stop_at = parse_count("--stop-at", text);
    });
}

void add_sharing_options(command_line& line, tile_options& target) {
    line.flag(target.plan, {"--plan", "",
                            "only make the tiles. Then any number of processes\n"
                            "process them (--tile K, K from 0), and one combines\n"
                            "the results (--finish), all with the same INPUT,\n"
                            "options and --work DIR"});
    line.option({"--tile", "K", "only process this tile"},
                [&target](std::string_view text) { target.tile = parse_count("--tile", text); });
    line.flag(target.finish, {"--finish", "", "only combine the results of all tiles; keeps DIR"});
}

void leave_reports_to_first(tile_options& tiles, common_options& options) {
    tiles.report = options.report;
    if (tiles.communicator.rank == 0) return;
    options.report.clear();
    options.log.clear();
}

void check_tile_options(const tile_options& tiles, const command_line& line,
                        const common_options& options) {
    if (tiles.is_shared() && tiles.communicator.size > 1)
        refuse("--plan, --tile and --finish are not for mpirun");
    if (tiles.communicator.size > 1 && options.inputs.size() != 1 && !options.joined)
        refuse("under mpirun, expected one INPUT, or --join");
    if (!tiles.is_shared()) return;
    if (int{tiles.plan} + int{tiles.tile.has_value()} + int{tiles.finish} > 1)
        refuse("--plan, --tile and --finish exclude each other");
    if (tiles.folder.empty())
        refuse("--plan, --tile and --finish need --work DIR, the same folder for all");
    if (options.inputs.size() != 1 && !options.joined)
        refuse("--plan, --tile and --finish take one INPUT");
    const std::vector<fs::path> outputs = line.outputs();
    const bool gives =
        std::ranges::any_of(outputs, [&](const fs::path& path) { return path != options.report; });
    if (tiles.is_part() && (gives || wants_mesh(options)))
        refuse("--plan and --tile write no output; --finish does");
}

void say_what_is_left(job& work, const fs::path& folder, const tile_options& tiles) {
    std::error_code error;
    if (tiles.is_shared() || !fs::exists(folder, error)) return;
    const bool piped = std::ranges::find(work.options.inputs, "-") != work.options.inputs.end();
    work.warn("work-left",
              folder.string() + (piped ? ": contains the tiles; remove the folder"
                                       : ": contains the tiles; the same command resumes from "
                                         "them, or remove the folder"));
}

void enter_tiles(job& work, std::size_t tiles, const fs::path& folder,
                 const std::vector<std::size_t>& unfinished) {
    work.entry["tiles"] = {
        {"count", tiles}, {"folder", folder.string()}, {"unfinished", unfinished}};
}

void say_tiles(job& work) {
    const json& tiles = work.entry["tiles"];
    const auto count = tiles["count"].get<std::size_t>();
    const std::size_t finished = count - tiles["unfinished"].size();
    work.out.result(work.name + ": " + counted(count, "tile", "tiles") + " in " +
                    tiles["folder"].get<std::string>() +
                    (finished > 0 ? ", " + grouped(finished) + " finished" : ""));
}

bool is_read_once(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    return path == "-" || (std::filesystem::exists(status) && std::filesystem::is_other(status));
}

std::string remark_on_folder(const tile_options& tiles) {
    return tiles.folder.empty()
               ? std::string()
               : "there is enough memory to work without tiles: --work is not used";
}

failure failure_of(const job& work, const tf::io_error& error) {
    using enum tf::io_error::kind;
    const std::string where = error.path() + ": ";
    switch (error.why()) {
        case folder:
            return {bad_output, "work-folder", error.what()};
        case folder_in_use:
            return {bad_output, "work-folder", where + "is in use by another process"};
        case folder_foreign:
            return {bad_output, "work-folder", where + "contains files of other programs"};
        case tile_write:
            return {bad_output, "output", error.what()};
        case file:
        case blocks:
        case tile_read:
            return {bad_input, "read", error.what()};
        case tile_damaged:
            return {bad_input, "damaged", error.what()};
        case memory:
            return {stopped, "memory", work.name + ": " + error.what()};
        case input_changed:
            break;
    }
    return {bad_input, "changed", work.name + ": the file changed while it was read"};
}

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
