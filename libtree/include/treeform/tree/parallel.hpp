#pragma once
/// \file
/// Parallel loops, work that is done once, and how long work reports progress.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <functional>
#include <memory>

namespace treeform {

/// Called now and then with the share of the work done, in [0, 1] and never decreasing; returning
/// false asks the operation to stop, which it does after the items under way. May be empty. It is
/// called from one thread at a time, not always the same one, and must not throw.
using progress_callback = std::function<bool(double done)>;

/// Runs `body(begin, end, chunk)` once for each piece [begin, end) of [0, count) of `grain`
/// elements (the last may be shorter), in any order, on the threads at hand. `chunk` counts the
/// pieces from 0. Returns when all are done; an exception of a body is passed on to the caller, one
/// of them when several throw, and chunks not yet begun may then be left out.
///
/// \pre  grain > 0
/// \cost a few microseconds a call beyond the first chunk; loops of one chunk run in place
TREEFORM_API void for_chunks(
    std::size_t count, std::size_t grain,
    detail::function_ref<void(std::size_t begin, std::size_t end, std::size_t chunk)> body);

/// Number of chunks that `for_chunks(count, grain, ...)` runs.
[[nodiscard]] constexpr std::size_t chunk_count(std::size_t count, std::size_t grain) {
    return count / grain + (count % grain != 0 ? 1 : 0);
}

/// Work that many threads ask for and one call does, such as an index built on first use.
class TREEFORM_API once {
  public:
    once();
    ~once();
    once(const once&) = delete;
    once& operator=(const once&) = delete;

    /// Runs `work` unless a call of it has returned before; then, or while another thread's is
    /// running, returns when that one has. `work` may itself run `for_chunks`: threads that wait
    /// help with its chunks, so that it cannot deadlock inside other loops, as `std::call_once`
    /// can. When `work` throws, its caller gets the exception, and the next call tries again.
    ///
    /// \pre `work` does not call the same `once`
    void call(detail::function_ref<void()> work);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Threads a loop may use now.
[[nodiscard]] TREEFORM_API unsigned thread_count();

/// While it lives, loops of the whole process use at most `threads` threads; 0 asks for all.
/// Nested scopes only lower the number.
class TREEFORM_API thread_scope {
  public:
    explicit thread_scope(unsigned threads);
    ~thread_scope();
    thread_scope(const thread_scope&) = delete;
    thread_scope& operator=(const thread_scope&) = delete;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
