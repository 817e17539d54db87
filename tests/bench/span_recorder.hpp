#pragma once
/// \file
/// How parallel a piece of work is, told by one thread. A program that is linked with it runs the
/// loops of treeform chunk after chunk, each timed: it stands in for `libtree/base/parallel.cpp`.

#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <vector>

namespace treeform::bench {

/// In seconds of the thread's processor time.
struct work_and_span {
    double work = 0.0;  ///< all of it
    /// What is left of it with any number of threads: all that is serial, and the longest chunk of
    /// each loop, whose loops count likewise.
    double span = 0.0;
    /// Where the span is: calls, innermost first, at equal intervals. None unless asked for.
    std::vector<std::vector<void*>> samples{};

    [[nodiscard]] double parallelism() const { return work / span; }
};

/// Of `run`, which may throw nothing. Work that is done once counts where it was asked
/// for first, as does what waits for it then.
///
/// \param sample_every seconds; 0 for no samples
/// \pre   from one thread, not from within `run`
[[nodiscard]] work_and_span record(detail::function_ref<void()> run, double sample_every = 0.0);

}  // namespace treeform::bench
