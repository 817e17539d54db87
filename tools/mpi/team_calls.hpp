#pragma once
/// \file
/// What treeform-mpi.so gives to the tool that loads it.

#include <cstddef>
#include <string>
#include <vector>

namespace tools {

/// `treeform_communicator()` returns them, or null where MPI cannot be started.
struct team_calls {
    std::size_t rank = 0;
    std::size_t size = 1;
    std::vector<std::string> (*exchange)(const std::string& sent) = nullptr;
    void (*leave)() = nullptr;
    void (*abort)(int status) = nullptr;  ///< ends all ranks
};

}  // namespace tools
