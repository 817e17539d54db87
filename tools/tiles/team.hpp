#pragma once
/// \file
/// The processes that mpirun has started, as a team. MPI itself is in a library of its own, which is
/// loaded where there is such a team and nowhere else.

#include <treeform/mesh/weld_stream.hpp>
#include <treeform/tf.hpp>

#include <functional>

namespace tools {

/// Runs a tool: as one of the team that mpirun has started, or alone. A failure of one ends all.
/// Returns its exit status.
[[nodiscard]] int run_in_team(const std::function<int(const tf::weld_team&)>& tool);

/// Waits a little, unless this is the first of the team. Where one fails, the others mostly fail for the
/// same reason: it is the first one that says so, if it can.
void let_first_speak(const tf::weld_team& team);

}  // namespace tools
