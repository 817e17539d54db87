#pragma once
/// \file
/// Parallel loops, work that is done once, progress callbacks.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <functional>
#include <memory>

namespace treeform {

/// Called from time to time with the completed share of the work, in [0, 1] and never decreasing.
/// Return false to stop the operation, which then ends after the work in progress. May be empty. It
/// is called from one thread at a time, not always the same one, and must not throw.
using progress_callback = std::function<bool(double done)>;

/// Cuts [0, count) into chunks [begin, end) of `grain` elements (the last may be shorter), and runs
/// `body(begin, end, chunk)` once for each, in parallel and in any order. Chunks are numbered from
/// 0. Returns when all are done. If a body throws, the exception (one of them, if several throw) is
/// rethrown, and chunks that have not begun may be skipped.
///
/// \pre  grain > 0
/// \cost a few microseconds of overhead; none for one chunk, which runs on the calling thread
TREEFORM_API void for_chunks(
    std::size_t count, std::size_t grain,
    detail::function_ref<void(std::size_t begin, std::size_t end, std::size_t chunk)> body);

/// A grain for elements that take a few nanoseconds each, so that the overhead of a chunk is
/// negligible.
inline constexpr std::size_t light_grain = std::size_t{1} << 12;

/// Number of chunks that `for_chunks(count, grain, ...)` runs.
[[nodiscard]] constexpr std::size_t chunk_count(std::size_t count, std::size_t grain) {
    return count / grain + (count % grain != 0 ? 1 : 0);
}

namespace detail {

/// Work that many threads may ask for, but that is done only once, such as an index that is built
/// on first use.
class TREEFORM_API once {
  public:
    once();
    ~once();
    once(const once&) = delete;
    once& operator=(const once&) = delete;

    /// Runs `work`, unless an earlier call has done so, and waits if another thread is doing it.
    /// `work` may itself run `for_chunks`: waiting threads help with its chunks, so it cannot
    /// deadlock inside other loops, as `std::call_once` can. If `work` throws, its caller gets the
    /// exception, and the next call tries again.
    ///
    /// \pre `work` does not call the same `once`
    void call(detail::function_ref<void()> work);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace detail

/// Number of threads that a loop may use now.
[[nodiscard]] TREEFORM_API unsigned thread_count();

/// During its lifetime, loops of the whole process use at most `threads` threads; 0 means all.
/// Nested scopes can only lower the number.
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
