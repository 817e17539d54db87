#pragma once
/// \file
/// Processes that do one work together, such as those that mpirun starts.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace treeform {

/// Processes that work together, each its share, in a folder that all see. All call the same with the
/// same options; outputs are those of rank 0, and where one fails, `exchange` must throw.
struct process_team {
    std::size_t rank = 0;
    std::size_t size = 1;
    /// Gives all of them what each gives, in the order of the ranks.
    std::function<std::vector<std::string>(const std::string&)> exchange{};
};

}  // namespace treeform
