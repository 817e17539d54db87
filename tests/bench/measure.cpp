#include "bench/measure.hpp"

#include <treeform/tree/parallel.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace treeform::bench {
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

/// 0: the first run counts.
int repetitions(effort effort, double seconds, int long_runs) {
    if (effort == effort::tiny) return 2;
    if (seconds > 2 && long_runs == 1) return 0;
    if (seconds > 10) return 1;
    return seconds < 0.05 ? 20 : long_runs;
}

}  // namespace

std::vector<measured> measure(const contest& contest, const setting& setting) {
    start_harness();
    std::vector<job> jobs;
    std::vector<measured> results;
    std::vector<std::size_t> again;  // those whose first run is not the one that counts
    for (const contestant& contestant : contest.contestants) {
        const job& job = jobs.emplace_back(contestant.prepare());
        const double first = seconds_of_run(job, contestant.threads);
        results.push_back(
            {.who = contestant.who,
             .threads = contestant.threads,
             .median = first,
             .low = first,
             .high = first,
             .runs = 1,
             .peak_mb = job.peak_mb(),
             .error = setting.only.empty() ? job.error() : std::nullopt,
             .figures = setting.only.empty() ? job.figures() : std::vector<figure>{}});
        job.discard();
        const int runs = repetitions(setting.effort, first, contest.long_runs);
        if (runs == 0) continue;
        again.push_back(results.size() - 1);
        const auto timed = [job, threads = contestant.threads](benchmark::State& state) {
            for ([[maybe_unused]] auto _ : state)
                state.SetIterationTime(seconds_of_run(job, threads));
            job.discard();
        };
        benchmark::RegisterBenchmark(std::to_string(jobs.size() - 1).c_str(), timed)
            ->UseManualTime()
            ->Iterations(1)
            ->Repetitions(runs);
    }
    collector times;
    if (!again.empty()) benchmark::RunSpecifiedBenchmarks(&times, ".");
    benchmark::ClearRegisteredBenchmarks();
    for (const std::size_t i : again) {
        const std::vector<double> seconds = times.sorted_seconds(std::to_string(i));
        results[i].median = median_of(seconds);
        results[i].low = seconds.front();
        results[i].high = seconds.back();
        results[i].runs = seconds.size();
    }
    return results;
}

}  // namespace treeform::bench
