#pragma once
/// \file
/// Signals, the time limit and the memory limit: a tool stops in order, and leaves nothing
/// half-written.

#include <cstdint>
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

}  // namespace tools
