#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cassert>

#ifdef TREEFORM_PLAIN_THREADS

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace treeform {
namespace {

unsigned hardware_threads() { return std::max(1U, std::thread::hardware_concurrency()); }

std::atomic<unsigned>& limit() {
    static std::atomic<unsigned> threads{hardware_threads()};
    return threads;
}

}  // namespace

struct thread_scope::state {
    unsigned before;
};

thread_scope::thread_scope(unsigned threads)
    : state_(std::make_unique<state>(state{limit().load()})) {
    if (threads != 0) limit().store(std::min(state_->before, threads));
}

thread_scope::~thread_scope() { limit().store(state_->before); }

unsigned thread_count() { return limit().load(); }

void for_chunks(std::size_t count, std::size_t grain,
                detail::function_ref<void(std::size_t, std::size_t, std::size_t)> body) {
    assert(grain > 0);
    const std::size_t chunks = chunk_count(count, grain);
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
            const std::size_t begin = chunk * grain;
            try {
                body(begin, begin + std::min(grain, count - begin), chunk);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < std::min<std::size_t>(chunks, thread_count()); ++t)
        others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

/// Threads of a nested loop are its own here, and none waits for what is not its own: a lock does.
struct detail::once::state {
    std::mutex mutex;
    std::atomic<bool> done{false};
};

void detail::once::call(detail::function_ref<void()> work) {
    if (state_->done.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(state_->mutex);
    if (state_->done.load(std::memory_order_relaxed)) return;
    work();
    state_->done.store(true, std::memory_order_release);
}

detail::once::once() : state_(std::make_unique<state>()) {}
detail::once::~once() = default;

}  // namespace treeform

#else

#include <tbb/blocked_range.h>
#include <tbb/collaborative_call_once.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace treeform {

struct thread_scope::state {
    tbb::global_control control;
};

thread_scope::thread_scope(unsigned threads) {
    if (threads != 0)
        state_.reset(new state{{tbb::global_control::max_allowed_parallelism, threads}});
}

thread_scope::~thread_scope() = default;

unsigned thread_count() {
    return static_cast<unsigned>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void for_chunks(std::size_t count, std::size_t grain,
                detail::function_ref<void(std::size_t, std::size_t, std::size_t)> body) {
    assert(grain > 0);
    const std::size_t chunks = chunk_count(count, grain);
    const auto run = [&](std::size_t chunk) {
        const std::size_t begin = chunk * grain;
        body(begin, begin + std::min(grain, count - begin), chunk);
    };
    if (chunks <= 1) {
        if (chunks == 1) run(0);
        return;
    }
    // In a context that is bound, a nested loop would end early, and without an exception, when
    // another chunk of the loop around it throws; what stands after it would read what is not
    // there.
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t chunk = range.begin(); chunk < range.end(); ++chunk) run(chunk);
        },
        tbb::simple_partitioner{}, own);
}

struct detail::once::state {
    tbb::collaborative_once_flag flag;
};

void detail::once::call(detail::function_ref<void()> work) {
    tbb::collaborative_call_once(state_->flag, [&] { work(); });
}

detail::once::once() : state_(std::make_unique<state>()) {}
detail::once::~once() = default;

}  // namespace treeform

#endif
