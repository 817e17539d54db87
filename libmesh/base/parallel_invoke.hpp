#pragma once
/// \file
/// Runs several tasks in parallel.

#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::base {

/// Calls all `tasks` in parallel; they must not share data. Useful for resizing large vectors,
/// since zeroing and page-faulting their memory takes as long as filling them.
template <class... Tasks>
void parallel_invoke(const Tasks&... tasks) {
    for_chunks(sizeof...(Tasks), 1, [&](std::size_t chosen, std::size_t, std::size_t) {
        std::size_t i = 0;
        ((i++ == chosen ? tasks() : void()), ...);
    });
}

}  // namespace treeform::detail::base
