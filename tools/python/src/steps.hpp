#pragma once
/// \file
/// Work in a folder that is done step by step, as a job each.

#include "job.hpp"

#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace binding {

/// What reports the progress of the step that is done now.
class step_progress {
  public:
    /// As options of the library take it.
    bool operator()(std::string_view, double share) const { return !report_ || report_(share); }

    void begin(treeform::progress_callback report) { report_ = std::move(report); }

  private:
    treeform::progress_callback report_;
};

/// A `Work` that Python's threads share: one step after the other. Also a step that nobody waits for
/// any more ends before the next one begins.
template <class Work>
class work_in_steps {
  public:
    /// `make(progress)` makes the work; its options refer to `progress`.
    template <class Make>
    explicit work_in_steps(Make&& make) : work_(make(progress_)) {}

    /// What `body(work)` returns, without the interpreter's lock.
    ///
    /// \throws std::invalid_argument after `close`
    template <class Body>
    auto step(Body&& body) {
        return run([&](const treeform::progress_callback& report) {
            const std::lock_guard one_at_a_time(mutex_);
            if (!work_) throw std::invalid_argument("closed: it has let go of the folder");
            progress_.begin(report);
            return body(*work_);
        });
    }

    /// Lets others have the folder.
    void close() {
        without_lock([&] {
            const std::lock_guard one_at_a_time(mutex_);
            work_.reset();
        });
    }

  private:
    step_progress progress_;
    std::mutex mutex_;
    std::optional<Work> work_;
};

}  // namespace binding
