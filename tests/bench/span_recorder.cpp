#include "bench/span_recorder.hpp"

#include <treeform/tree/parallel.hpp>

#include <execinfo.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <csignal>
#include <memory>

namespace treeform {
namespace bench {
namespace {

struct sample {
    std::array<void*, 48> calls;
    int count;
};

constexpr std::size_t most_samples = std::size_t{1} << 15;

/// Of the thread. Samples of what has turned out not to be in the span are overwritten.
struct state {
    double work = 0.0;
    double span = 0.0;  ///< of the chunk that runs
    double since = 0.0;
    volatile std::size_t samples = 0;
};
state now;
std::unique_ptr<sample[]> taken;

double seconds() {
    timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Counts what has run since the last call, or since `resume`.
void settle() {
    const double passed = seconds() - now.since;
    now.work += passed;
    now.span += passed;
}

void resume() { now.since = seconds(); }

void take_sample(int) {
    if (now.samples == most_samples) return;
    sample& s = taken[now.samples];
    s.count = ::backtrace(s.calls.data(), static_cast<int>(s.calls.size()));
    now.samples = now.samples + 1;
}

/// Takes samples as long as it exists.
class sampling {
  public:
    explicit sampling(double every) {
        if (every <= 0.0) return;
        taken = std::make_unique<sample[]>(most_samples);
        take_sample(0);  // what `backtrace` loads, it loads now
        now.samples = 0;
        struct sigaction action {};
        action.sa_handler = take_sample;
        action.sa_flags = SA_RESTART;
        ::sigaction(SIGUSR1, &action, nullptr);
        sigevent event{};
        event.sigev_notify = SIGEV_SIGNAL;
        event.sigev_signo = SIGUSR1;
        ::timer_create(CLOCK_MONOTONIC, &event, &timer_);
        const itimerspec at{{0, static_cast<long>(1e9 * every)}, {0, 1}};
        ::timer_settime(timer_, 0, &at, nullptr);
        runs_ = true;
    }
    ~sampling() {
        if (runs_) ::timer_delete(timer_);
        ::signal(SIGUSR1, SIG_IGN);
    }
    sampling(const sampling&) = delete;
    sampling& operator=(const sampling&) = delete;

  private:
    timer_t timer_{};
    bool runs_ = false;
};

}  // namespace

work_and_span record(detail::function_ref<void()> run, double sample_every) {
    now = state{};
    {
        const sampling samples(sample_every);
        resume();
        run();
        settle();
    }
    work_and_span result{now.work, now.span};
    for (std::size_t i = 0; i < now.samples; ++i)
        result.samples.emplace_back(taken[i].calls.begin(),
                                    taken[i].calls.begin() + taken[i].count);
    return result;
}

}  // namespace bench

void for_chunks(std::size_t count, std::size_t grain,
                detail::function_ref<void(std::size_t, std::size_t, std::size_t)> body) {
    using bench::now;
    assert(grain > 0);
    const std::size_t chunks = chunk_count(count, grain);
    if (chunks <= 1) {
        if (chunks == 1) body(0, count, 0);
        return;
    }
    bench::settle();
    const double before = now.span;
    const std::size_t first = now.samples;
    std::size_t kept = first;  // samples of the longest chunk end here
    double longest = 0.0;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t begin = chunk * grain;
        now.span = 0.0;
        now.samples = kept;
        bench::resume();
        body(begin, begin + std::min(grain, count - begin), chunk);
        bench::settle();
        if (now.span <= longest) continue;
        longest = now.span;
        const std::size_t end = now.samples;
        if (kept != end) std::copy(&bench::taken[kept], &bench::taken[end], &bench::taken[first]);
        kept = first + (end - kept);
    }
    now.span = before + longest;
    now.samples = kept;
    bench::resume();
}

struct detail::once::state {
    bool done = false;
};

void detail::once::call(detail::function_ref<void()> work) {
    if (state_->done) return;
    work();
    state_->done = true;
}

detail::once::once() : state_(std::make_unique<state>()) {}
detail::once::~once() = default;

struct thread_scope::state {};

thread_scope::thread_scope(unsigned) {}
thread_scope::~thread_scope() = default;

unsigned thread_count() { return 1; }

}  // namespace treeform
