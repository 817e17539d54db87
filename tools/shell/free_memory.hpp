#pragma once
/// \file
/// How much memory the machine, or the container, has left.

#include <cstdint>
#include <filesystem>

namespace tools {

/// Bytes that programs may still take: what the machine has available and free to swap to, and no
/// more than each control group that this process is in (version 1 or 2) has left. Pages of files
/// count as free: they go when memory is short. 0 where it is not known.
///
/// \param system  where `proc` and `sys` are: for tests
[[nodiscard]] std::uint64_t free_memory(const std::filesystem::path& system = "/");

/// What a process may take of `free_memory`, and of what its own limits (ulimit) say: all but a
/// small part for the others. 0 where it is not known.
[[nodiscard]] std::uint64_t usable_memory();

}  // namespace tools
