#pragma once
/// \file
/// Several things done at the same time.

#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::base {

/// Calls all `tasks`, which share nothing. Large vectors, for one, are resized so: to write their
/// zeros, and have their pages mapped, takes as long as to fill them.
template <class... Tasks>
void parallel_invoke(const Tasks&... tasks) {
    for_chunks(sizeof...(Tasks), 1, [&](std::size_t chosen, std::size_t, std::size_t) {
        std::size_t i = 0;
        ((i++ == chosen ? tasks() : void()), ...);
    });
}

}  // namespace treeform::detail::base
