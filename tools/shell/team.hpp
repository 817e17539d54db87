#pragma once
/// \file
/// The processes that mpirun has started, as a team. MPI itself is in a library of its own, which
/// is loaded where there is such a team and nowhere else.

#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <functional>
#include <string>

namespace tools {

struct team_member {
    tf::communicator communicator{};
    std::string error{};  ///< to be set by a tool that fails: what it says of it
};

/// Runs a tool: as one of the team that mpirun has started, or alone. Only the first one is heard.
/// A failure of one ends all: where they meet next, `exchange` throws it, or else after some
/// seconds. Returns the exit status.
[[nodiscard]] int run_in_team(const std::function<int(team_member&)>& tool);

}  // namespace tools
