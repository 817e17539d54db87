#pragma once
/// \file
/// A loop on all threads.

#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::base {

/// Calls `body` with each number below `count`; `grain` as of `for_chunks`.
template <class Body>
void for_numbers(std::size_t count, std::size_t grain, const Body& body) {
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    });
}
template <class Body>
void for_numbers(std::size_t count, const Body& body) {
    for_numbers(count, light_grain, body);
}

}  // namespace treeform::detail::base
