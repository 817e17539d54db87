#pragma once
/// \file
/// Signals, the time limit and the memory limit: a tool stops in order, and leaves nothing
/// half-written. What it may take of the memory.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace tools {

struct limits {
    double seconds = 0.0;      ///< 0: none
    std::uint64_t memory = 0;  ///< bytes; 0: none
    bool as_free = false;      ///< `memory` is what was free, not what was asked for
    /// `memory` is beside what the process has already, for the sake of others: MPI.
    bool beside_others = false;
};

/// Watches from a thread of its own. When SIGINT, SIGTERM or SIGHUP arrives or a limit is passed,
/// `check` throws and the tool ends with `stopped`. If it has not ended within a second (where
/// mpirun would kill it by then, sooner), or at a second signal, the guard removes the unfinished
/// files and ends the process with `stopped`. Memory is also bounded by the system (RLIMIT_DATA),
/// so an allocation beyond the limit fails with std::bad_alloc rather than pass it unseen. The
/// system counts what is reserved, too: stacks of threads, which are hardly used, are allowed on
/// top of it.
///
/// Make one before any other thread; threads made later inherit the blocked signals.
class guard {
  public:
    explicit guard(limits bounds);
    ~guard();
    guard(const guard&) = delete;
    guard& operator=(const guard&) = delete;

    /// \throws failure (stopped) naming what asked for the stop
    void check() const;
    [[nodiscard]] bool stop_requested() const;
    /// Why there is no memory for more.
    [[nodiscard]] std::string want_of_memory() const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Largest memory in use so far, in bytes.
[[nodiscard]] std::uint64_t peak_memory();

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
