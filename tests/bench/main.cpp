/// \file
/// Measures treeform beside its peers; tests/bench/run.sh builds and calls it.

#include "bench/measure.hpp"
#include "bench/page.hpp"
#include "bench/report.hpp"
#include "bench/workload.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace bench = treeform::bench;

/// Names one contestant of one contest to a process that measures its memory.
std::string key_of(const bench::contest& contest, const bench::contestant& contestant) {
    return fmt::format("{}|{}|{}", contest.name, contestant.threads, contestant.who);
}

/// "E1" names itself, "E" all that begin with it.
bool names(const std::string& id, const bench::workload& workload) {
    return workload.id == id || (id.size() == 1 && workload.id.starts_with(id));
}

void check_ids(const std::vector<std::string>& ids) {
    for (const std::string& id : ids)
        if (std::ranges::none_of(bench::workloads(), [&](const auto& w) { return names(id, w); }))
            throw std::runtime_error("no workload is called " + id);
}

/// Prints the peak of the contestant that `key` names; what `measure_all` starts processes for.
void print_peak(const bench::setting& setting, const std::string& id, const std::string& key) {
    for (const bench::workload& workload : bench::workloads()) {
        if (workload.id != id) continue;
        workload.contests(setting, [&](const bench::contest& contest) {
            for (const bench::contestant& contestant : contest.contestants)
                if (key_of(contest, contestant) == key)
                    if (const auto peak = bench::own_peak_mb(contestant)) fmt::print("{}\n", *peak);
        });
    }
}

void measure_all(const bench::setting& setting, const std::vector<std::string>& ids,
                 const std::string& folder, const std::vector<std::string>& this_command) {
    std::filesystem::create_directories(folder);
    bench::write_machine(folder);
    bench::csv_report csv(folder);
    bench::table table;
    bench::page page(bench::machine_name());
    for (const bench::workload& workload : bench::workloads()) {
        if (!ids.empty() &&
            std::ranges::none_of(ids, [&](const std::string& id) { return names(id, workload); }))
            continue;
        fmt::print("\n== {}  {}\n", workload.id, workload.title);
        std::vector<bench::outcome> outcomes;
        workload.contests(setting, [&](bench::contest contest) {
            if (!setting.only.empty()) {
                std::erase_if(contest.contestants,
                              [&](const auto& c) { return c.who != setting.only; });
                contest.with_memory = false;
                if (contest.contestants.empty()) return;
            }
            const std::size_t size = contest.size();
            std::vector<bench::measured> results = bench::measure(contest, setting);
            for (std::size_t i = 0; contest.with_memory && i < results.size(); ++i) {
                std::vector<std::string> command = this_command;
                command.insert(command.end(),
                               {"--peak-of", key_of(contest, contest.contestants[i]), workload.id});
                results[i].peak_mb = bench::number_printed_by(command);
            }
            csv.add(workload.id, contest, size, results);
            table.add(contest, size, results);
            outcomes.push_back({contest.name, size, contest.unit, std::move(results)});
        });
        if (!setting.only.empty()) continue;  // charts compare
        page.add(workload, outcomes);
        page.write(folder);  // each time: a run that is cut short leaves what it has
    }
}

int run(int argc, char** argv) {
    CLI::App app("Measures treeform beside its peers.", "bench");
    bench::setting setting;
    std::vector<std::string> ids;
    std::string folder = ".";
    std::string peak_of;
    bool quick = false;
    bool tiny = false;
    app.add_option("ID", ids,
                   "workloads, such as B1, or B for all of them; all when none is named");
    app.add_flag("--quick", quick, "smaller models, within three minutes");
    app.add_flag("--tiny", tiny, "only see that everything runs");
    app.add_option("--only", setting.only, "only contestants of this name; their times alone");
    app.add_option("--out", folder, "folder of bench.csv, machine.txt and index.html");
    app.add_option("--models", setting.models_dir, "folder of real models");
    app.add_option("--cache", setting.cache_dir, "folder for models and files made here")
        ->required();
    app.add_option("--peak-of", peak_of)->group("");  // not shown: how the bench calls itself
    CLI11_PARSE(app, argc, argv);

    setting.effort = tiny    ? bench::effort::tiny
                     : quick ? bench::effort::quick
                             : bench::effort::full;
    check_ids(ids);
    const std::string cache = setting.cache_dir;
    setting.cache_dir += std::string("/") + bench::cache_version;
    std::filesystem::create_directories(setting.cache_dir);
    if (!peak_of.empty()) {
        print_peak(setting, ids.at(0), peak_of);
        return 0;
    }
    std::vector<std::string> this_command{std::filesystem::canonical("/proc/self/exe").string(),
                                          "--cache", cache};
    if (!setting.models_dir.empty())
        this_command.insert(this_command.end(), {"--models", setting.models_dir});
    if (tiny || quick) this_command.emplace_back(tiny ? "--tiny" : "--quick");
    measure_all(setting, ids, folder, this_command);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& failure) {
        fmt::print(stderr, "bench: {}\n", failure.what());
        return 1;
    }
}
