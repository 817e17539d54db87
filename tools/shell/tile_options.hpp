#pragma once
/// \file
/// Options and errors of tools that work in tiles on the disk where memory is short. The processes
/// that mpirun has started, as a team: MPI itself is in a library of its own, which is loaded where
/// there is such a team and nowhere else.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace tools {

struct tile_options {
    std::filesystem::path folder{};  ///< as asked for
    std::uint64_t per_tile = 0;      ///< things in a tile; 0: as the memory allows
    /// What of the work this process does, of many; none: all of it.
    bool plan = false;
    std::optional<std::uint64_t> tile{};
    bool finish = false;
    tf::communicator communicator{};  ///< of mpirun
    std::filesystem::path report{};   ///< as asked for, also where another process writes it
    std::uint64_t stop_at = 0;        ///< for tests: the process kills itself after so many steps

    /// Whether other processes share the folder, and do not know of each other.
    [[nodiscard]] bool is_shared() const { return plan || tile || finish; }
    [[nodiscard]] bool has_others() const { return is_shared() || communicator.size > 1; }
    /// Whether this one only does a part, and has nothing to give back.
    [[nodiscard]] bool is_part() const { return plan || tile; }
    /// Whether tiles are asked for, whatever the memory.
    [[nodiscard]] bool is_asked() const { return per_tile > 0 || has_others(); }
    /// Where tiles go: as asked, or beside the first of `outputs` that is a file, or in the folder
    /// for temporary files; then its name ends with that of the tool.
    [[nodiscard]] std::filesystem::path folder_for(
        const job& work, const std::string& tool,
        std::initializer_list<std::filesystem::path> outputs) const;
    /// To be called when a step has been done.
    [[nodiscard]] std::function<void()> step_done() const;
};

/// Adds a group with this heading; `per_tile` is the name of the option for the size of tiles.
void add_tile_options(command_line& line, tile_options& target, const std::string& heading,
                      const std::string& per_tile);
/// Adds the options of work that many processes share.
void add_sharing_options(command_line& line, tile_options& target);

/// Of several ranks, only the first one writes a report or a log.
void leave_reports_to_first(tile_options& tiles, common_options& options);

/// \throws failure (bad_usage) for options that exclude each other or need others
void check_tile_options(const tile_options& tiles, const command_line& line,
                        const common_options& options);

void say_what_is_left(job& work, const std::filesystem::path& folder, const tile_options& tiles);
/// Does `step`, which works in `folder`. Where it fails and work is left there, says so.
template <class Step>
auto work_in(job& work, const std::filesystem::path& folder, const tile_options& tiles,
             const Step& step) {
    try {
        return step();
    } catch (const failure& error) {
        if (error.code() != "work-folder") say_what_is_left(work, folder, tiles);
        throw;
    } catch (const std::exception&) {
        say_what_is_left(work, folder, tiles);
        throw;
    }
}

/// For the report: how many tiles there are, where, and which are not finished.
void enter_tiles(job& work, std::size_t tiles, const std::filesystem::path& folder,
                 const std::vector<std::size_t>& unfinished);
/// Says the same of tiles that are made.
void say_tiles(job& work);
/// Whether it can be read once only: standard input, a pipe, a device.
[[nodiscard]] bool is_read_once(const std::filesystem::path& path);
/// Where a folder for tiles was asked for, but there are none: that. Else empty.
[[nodiscard]] std::string remark_on_folder(const tile_options& tiles);

/// What the library says of its files, for the person and the shell.
[[nodiscard]] failure failure_of(const job& work, const tf::io_error& error);

struct team_member {
    tf::communicator communicator{};
    std::string error{};  ///< to be set by a tool that fails: what it says of it
};

/// Runs a tool: as one of the team that mpirun has started, or alone. Only the first one is heard.
/// A failure of one ends all: where they meet next, `exchange` throws it, or else after some
/// seconds. Returns the exit status.
[[nodiscard]] int run_in_team(const std::function<int(team_member&)>& tool);

}  // namespace tools
