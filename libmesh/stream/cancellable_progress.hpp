#pragma once
/// \file
/// Thread-safe progress, which throws if the caller cancels.

#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace treeform::detail::stream {

/// Thrown if the progress callback returned false; caught by the public functions.
struct cancelled {};

class cancellable_progress {
  public:
    explicit cancellable_progress(std::function<bool(std::string_view, double)> progress)
        : progress_(std::move(progress)) {}

    /// \throws cancelled
    void show(std::string_view step, double share) {
        const std::lock_guard lock(one_at_a_time_);
        step_ = step;
        share_ = share;
        ask();
    }
    /// \throws cancelled
    void check() {
        const std::lock_guard lock(one_at_a_time_);
        ask();
    }

  private:
    void ask() const {
        if (progress_ && !progress_(step_, share_)) throw cancelled{};
    }

    std::function<bool(std::string_view, double)> progress_;
    std::mutex one_at_a_time_{};
    std::string step_{"survey"};
    double share_ = 0.0;
};

}  // namespace treeform::detail::stream
