#include "bench/measure.hpp"

#include <libtree/parallel.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace tf::bench {
namespace {

using benchmark::BenchmarkReporter;

double seconds_of_run(const job& job, unsigned threads) {
    const thread_scope scope(threads);  // holds for every user of TBB in this process
    const auto start = std::chrono::steady_clock::now();
    job.run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Keeps the times of single runs by the name of their benchmark, prints nothing.
class collector : public BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Iteration)
                seconds_[run.run_name.function_name].push_back(run.real_accumulated_time /
                                                               static_cast<double>(run.iterations));
    }
    [[nodiscard]] std::vector<double> sorted_seconds(const std::string& name) const {
        std::vector<double> seconds = seconds_.at(name);
        std::sort(seconds.begin(), seconds.end());
        return seconds;
    }

  private:
    std::map<std::string, std::vector<double>> seconds_;
};

/// The harness shuffles the repetitions of all benchmarks only when asked on its command line.
void start_harness() {
    static std::once_flag started;
    std::call_once(started, [] {
        char program[] = "bench";
        char interleave[] = "--benchmark_enable_random_interleaving=true";
        char* arguments[] = {program, interleave, nullptr};
        int count = 2;
        benchmark::Initialize(&count, arguments);
    });
}

double median_of(const std::vector<double>& sorted) {
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

int repetitions(effort effort, double seconds, int long_runs) {
    if (effort == effort::tiny) return 2;
    if (seconds > 10) return 1;
    return seconds < 0.05 ? 20 : long_runs;
}

}  // namespace

std::vector<measured> measure(const contest& contest, const setting& setting) {
    start_harness();
    std::vector<job> jobs;
    std::vector<measured> results;
    for (const contestant& contestant : contest.contestants) {
        const job& job = jobs.emplace_back(contestant.prepare());
        const double warm_up = seconds_of_run(job, contestant.threads);
        results.push_back({.who = contestant.who,
                           .threads = contestant.threads,
                           .error = job.error(),
                           .figures = job.figures()});
        job.discard();
        const auto timed = [job, threads = contestant.threads](benchmark::State& state) {
            for ([[maybe_unused]] auto _ : state)
                state.SetIterationTime(seconds_of_run(job, threads));
            job.discard();
        };
        benchmark::RegisterBenchmark(std::to_string(jobs.size() - 1).c_str(), timed)
            ->UseManualTime()
            ->Iterations(1)
            ->Repetitions(repetitions(setting.effort, warm_up, contest.long_runs));
    }
    collector times;
    benchmark::RunSpecifiedBenchmarks(&times, ".");
    benchmark::ClearRegisteredBenchmarks();
    for (std::size_t i = 0; i < results.size(); ++i) {
        const std::vector<double> seconds = times.sorted_seconds(std::to_string(i));
        results[i].median = median_of(seconds);
        results[i].low = seconds.front();
        results[i].high = seconds.back();
        results[i].runs = seconds.size();
    }
    return results;
}

}  // namespace tf::bench
