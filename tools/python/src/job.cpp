#include "job.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace binding {
namespace {

/// A thread that waits for tasks. It is never joined: at the end of the process it sleeps.
class helper {
  public:
    helper() {
        std::thread([this] { serve(); }).detach();
    }

    void start(const std::function<void()>& task) {
        {
            const std::lock_guard lock(mutex_);
            task_ = &task;
        }
        wake_.notify_one();
    }

    /// Whether the task has ended, now or within `time`.
    bool has_ended_within(std::chrono::milliseconds time) {
        std::unique_lock lock(mutex_);
        return ended_.wait_for(lock, time, [this] { return task_ == nullptr; });
    }

  private:
    [[noreturn]] void serve() {
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [this] { return task_ != nullptr; });
            lock.unlock();
            (*task_)();
            lock.lock();
            task_ = nullptr;
            ended_.notify_one();
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable ended_;
    const std::function<void()>* task_ = nullptr;
};

/// The helpers that have nothing to do.
class helpers {
  public:
    helper& take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty()) return *new helper;
        helper& one = *idle_.back();
        idle_.pop_back();
        return one;
    }
    void give_back(helper& one) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(&one);
    }

  private:
    std::mutex mutex_;
    std::vector<helper*> idle_;
};

/// Those of this process: a fork has none of the threads of its parent.
std::atomic<helpers*> all_helpers = [] {
    pthread_atfork(nullptr, nullptr, [] { all_helpers = new helpers; });
    return new helpers;
}();

constexpr std::chrono::milliseconds between_looks{20};
constexpr std::size_t little = 4096;

/// Reports the share that is done. False when that says to stop.
bool report(const py::object& progress, double share) {
    return !progress(share).is(py::bool_(false));
}

/// What the thread that called does meanwhile: returns when the task has ended.
class watch {
  public:
    watch(const py::object& progress, std::atomic<double>& share, std::atomic<bool>& stop)
        : progress_(progress), share_(share), stop_(stop) {}

    void until_end_of(helper& one) {
        while (true) {
            {
                const py::gil_scoped_release others_run;
                if (one.has_ended_within(between_looks)) return;
            }
            look(share_);
        }
    }

    /// Looks for signals and says how far it is, unless it is to stop already.
    void look(double share) {
        if (stop_) return;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (progress_.is_none() || share <= reported_) return;
            reported_ = share;
            if (!report(progress_, share)) throw cancelled();
        } catch (...) {
            why_ = std::current_exception();
            stop_ = true;
        }
    }

    void rethrow() const {
        if (why_) std::rethrow_exception(why_);
    }

  private:
    const py::object& progress_;
    std::atomic<double>& share_;
    std::atomic<bool>& stop_;
    double reported_ = -1.0;
    std::exception_ptr why_;
};

}  // namespace

void run_job(const py::object& progress, std::size_t elements,
             const std::function<void(const treeform::progress_callback&)>& body) {
    if (elements < little && progress.is_none()) {
        const py::gil_scoped_release others_run;
        body({});
        return;
    }
    std::atomic<double> share{0.0};
    std::atomic<bool> stop{false};
    std::exception_ptr failure;
    const std::function<void()> task = [&] {
        try {
            body([&](double done) {
                share = done;
                return !stop;
            });
        } catch (...) {
            failure = std::current_exception();
        }
    };
    watch caller(progress, share, stop);
    helper& one = all_helpers.load()->take();
    one.start(task);
    caller.until_end_of(one);
    all_helpers.load()->give_back(one);
    if (!failure) caller.look(1.0);
    caller.rethrow();
    if (failure) std::rethrow_exception(failure);
}

void run_pieces(const py::object& progress, std::size_t count, std::size_t piece,
                const std::function<void(std::size_t, std::size_t)>& body) {
    run_job(progress, count, [&](const treeform::progress_callback& report) {
        for (std::size_t begin = 0; begin < count; begin += piece) {
            if (report && !report(static_cast<double>(begin) / static_cast<double>(count))) return;
            body(begin, std::min(count, begin + piece));
        }
    });
}

}  // namespace binding
