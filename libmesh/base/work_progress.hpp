#pragma once
/// \file
/// The progress of an operation that consists of steps, and its cancellation.

#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace treeform::detail::base {

/// Reports progress that never decreases. After the callback returned false, it is not called
/// again. May be used from several threads.
class work_progress {
  public:
    explicit work_progress(const progress_callback& callback) : callback_(callback) {}

    [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

    /// Reports that the share `done` of the work, in [0, 1], is completed. Returns false if the
    /// operation is to stop.
    bool reach(double done) {
        if (!callback_) return true;
        const std::lock_guard lock(mutex_);
        furthest_ = std::max(furthest_, done);
        if (!cancelled() && !callback_(furthest_)) cancelled_ = true;
        return !cancelled();
    }

    /// The same for the part from `begin` to `end`, after `steps` of an unknown number of steps;
    /// after `expected` steps, half of the part is reported.
    bool step(double begin, double end, std::size_t steps, double expected) {
        const auto n = static_cast<double>(steps);
        return reach(begin + (end - begin) * n / (n + expected));
    }

    /// A callback for an operation that is the part from `begin` to `end` of this work; this must
    /// outlive it.
    [[nodiscard]] progress_callback part(double begin, double end) {
        if (!callback_) return {};
        return [this, begin, end](double done) { return reach(begin + (end - begin) * done); };
    }

  private:
    const progress_callback& callback_;
    std::mutex mutex_;
    double furthest_ = 0.0;
    std::atomic<bool> cancelled_{false};
};

}  // namespace treeform::detail::base
